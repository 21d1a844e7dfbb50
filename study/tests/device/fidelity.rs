//! The drawn surface of a coarse beaker of water against the truth.

use vitriol_render::View;
use vitriol_run::Failure;
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{StepInput, World};
use vitriol_study::fidelity::judge::{self, Draw, Drawn, Task};
use vitriol_study::fidelity::report::{DrawnRow, Manner, rows};
use vitriol_study::fidelity::screen::{MANNERS, Screen};
use vitriol_study::fidelity::states::{State, StateSpec};
use vitriol_tests::gpu;

/// A right eye that gets the left one's frustum, as by a renderer that takes frusta to be alike.
struct Alike(Screen);

impl Draw for Alike {
    fn draw(
        &mut self,
        state: &State,
        [left, right]: &[View; 2],
        manner: Manner,
    ) -> Result<[Drawn; 2], Failure> {
        let right = View {
            fov: left.fov,
            ..*right
        };
        self.0.draw(state, &[*left, right], manner)
    }
}

#[test]
fn what_is_drawn_is_the_surface_of_its_particles() {
    let device = gpu::device();
    let library = Library::embedded();
    let mut scene = Scene::builtin("beaker").unwrap();
    scene.scale.spacing *= 2.0;
    scene.solver.substeps = 4;
    let mut world = World::new(&device, &library, &scene, 1).unwrap();
    for _ in 0..20 {
        let hands = [Hand::ABSENT; 2];
        world.step(&StepInput::of_hands(hands)).unwrap();
    }
    let spec = StateSpec {
        name: "coarse",
        scene: "beaker",
        track: "hands-off",
        seconds: 0.2,
        target: [0.0, 0.785, -0.40],
        reach: 0.06,
    };
    let state = State::new(spec, world).unwrap();
    let size = [160, 120];
    let task = Task {
        state: &state,
        shapes: &judge::shapes(&state),
        size,
        whole: true,
        manners: &MANNERS[..1],
    };
    let mut screen = Screen::new(&device, &library, size, state.world.solver().count()).unwrap();
    screen.set_scene(&state).unwrap();
    let judged = |draw: &mut dyn Draw| {
        let mut samples = 0;
        let pictures = task.judge(draw, |_, _| samples += 1).unwrap();
        assert_eq!((pictures.len(), samples), (8, 1));
        let [truth, drawn]: [DrawnRow; 2] = rows(&pictures).try_into().unwrap();
        (truth.figures, drawn.figures)
    };
    let (truth, drawn) = judged(&mut screen);

    assert_eq!((truth.silhouette_iou, truth.depth_rms_radii), (1.0, 0.0));
    // Particles of 5 mm in a beaker of 66 mm; the liquid is not at rest yet.
    assert!((truth.volume_ratio - 1.0).abs() < 0.08, "{truth:?}");
    // The project's targets.
    assert!(drawn.silhouette_iou >= 0.97, "{drawn:?}");
    assert!(drawn.depth_rms_radii <= 0.5, "{drawn:?}");
    assert!(drawn.normal_angle_deg <= 8.0, "{drawn:?}");
    assert!(drawn.reprojection_rms_radii <= 0.5, "{drawn:?}");
    assert!(drawn.flicker_rms_radii <= 0.1, "{drawn:?}");
    assert!((drawn.volume_ratio - 1.0).abs() <= 0.05, "{drawn:?}");

    let (_, alike) = judged(&mut Alike(screen));
    assert!(alike.silhouette_iou < 0.9, "{alike:?}");
    assert!(alike.reprojection_rms_radii > 1.0, "{alike:?}");
}
