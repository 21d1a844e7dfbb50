//! The scenes that cases start from, and their parameters that an extreme changes.

use std::f64::consts::PI;

use vitriol_sim::surface_tension::WATER;

use super::motion::Motion;

/// The scene that a case changes.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Base {
    /// Water in a glass, at real size.
    Water,
    /// The paper's world and chemistry, Table 1: water over acid.
    Paper,
    /// Likewise at real size, by the physical chemistry with all of its parts.
    Physical,
}

impl Base {
    /// The bases from which cases are drawn.
    pub const ALL: [Self; 3] = [Self::Water, Self::Paper, Self::Physical];

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Water => "water",
            Self::Paper => "paper",
            Self::Physical => "physical",
        }
    }
}

/// Initial places of particles, if not those of the filling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crowd {
    /// The places of the filling.
    Filled,
    /// This share of them in one place.
    OnePlace(f64),
    /// All in a ball of this radius, support radii: more neighbours than a list
    /// holds.
    Ball(f64),
}

/// One case's scene, lengths in particle spacings where they are the flask's.
#[derive(Clone, Debug)]
pub struct Recipe {
    pub base: Base,
    pub spacing: f64,
    pub support_ratio: f64,
    pub frame_time: f64,
    pub gravity: f64,
    pub rest_density: f64,
    pub length_scale: f64,
    pub substeps: u32,
    pub iterations: u32,
    pub chebyshev: bool,
    pub omega: f64,
    pub carry_rate: f64,
    pub v_max: f64,
    pub boundary_particles: bool,
    pub viscosity: f64,
    /// σ, N/m, and the glass's contact angle, degrees; `None` at the paper's scale.
    pub tension: Option<[f64; 2]>,
    /// Inner radius and height over d.
    pub radius: f64,
    pub height: f64,
    /// Particles; `None` to the brim.
    pub particles: Option<u32>,
    /// Temperatures (°C) of the lower and the upper liquid; equal for water.
    pub temperatures: [f64; 2],
    pub k_v: f64,
    pub boiling_point: f64,
    /// Diffusivities over those of the base.
    pub diffusion: f64,
    pub upside_down: bool,
    /// Origin of the scene in the stage, metres.
    pub origin: [f64; 3],
    /// Distance of its places from its origin, metres.
    pub place: [f64; 3],
    pub crowd: Crowd,
    pub motion: Motion,
}

impl Recipe {
    /// The scene without any extreme.
    pub fn of(base: Base) -> Self {
        let real = Self {
            base,
            spacing: 0.0025,
            support_ratio: 2.0,
            frame_time: 1.0 / 90.0,
            gravity: 9.81,
            rest_density: 1000.0,
            length_scale: 1.0,
            substeps: 10,
            iterations: 3,
            chebyshev: true,
            omega: 0.33,
            carry_rate: 2.25,
            v_max: 10.0,
            boundary_particles: false,
            viscosity: 0.05,
            tension: Some([WATER, 30.0]),
            radius: 5.0,
            height: 24.0,
            particles: Some(400),
            temperatures: [20.0; 2],
            k_v: 1.0,
            boiling_point: 100.0,
            diffusion: 1.0,
            upside_down: false,
            origin: [0.0; 3],
            place: [0.0; 3],
            crowd: Crowd::Filled,
            motion: Motion::Still,
        };
        match base {
            Base::Water | Base::Physical => real,
            Base::Paper => Self {
                spacing: 0.05,
                frame_time: 1.0 / 60.0,
                length_scale: 0.05,
                substeps: 3,
                iterations: 2,
                chebyshev: false,
                omega: 0.35,
                carry_rate: 0.0,
                v_max: 25.0,
                viscosity: 0.3,
                tension: None,
                ..real
            },
        }
    }

    /// Δt_s, s.
    pub fn substep(&self) -> f64 {
        self.frame_time / f64::from(self.substeps)
    }

    /// Support radius h, m.
    pub fn support(&self) -> f64 {
        self.spacing * self.support_ratio
    }

    /// Position of the flask's base.
    pub fn flask_position(&self) -> [f64; 3] {
        let [x, y, z] = self.place;
        let up = if self.upside_down {
            (self.height + WALL + 1.0) * self.spacing
        } else {
            0.0
        };
        [x, y + TABLE * self.spacing + up, z]
    }

    /// Diffusivities D_T and D_c of the paper's chemistry, m²/s.
    pub fn diffusivities(&self) -> [f64; 2] {
        [0.01, 0.007].map(|d| d * self.diffusion)
    }

    /// Surface tension and contact angle; `None` with boundary particles, which do not have them.
    pub fn surface(&self) -> Option<[f64; 2]> {
        self.tension.filter(|_| !self.boundary_particles)
    }

    /// Names of the modelled features.
    fn model(&self) -> Vec<&'static str> {
        let mut model = match self.base {
            Base::Water => Vec::new(),
            Base::Paper => vec!["heat", "dilution", "boiling"],
            Base::Physical => vec![
                "heat",
                "dilution",
                "density",
                "viscosity",
                "evaporation",
                "bubbles",
                "spray",
                "air",
                "losses",
                "segregation",
            ],
        };
        model.extend(self.surface().map(|_| "tension"));
        model
    }

    /// Text of the scene's file.
    pub fn text(&self) -> String {
        let d = self.spacing;
        let model = self.model();
        let relaxation = ["jacobi", "chebyshev"][usize::from(self.chebyshev)];
        let walls = ["map", "particles"][usize::from(self.boundary_particles)];
        let mut t = format!(
            "name = \"extreme\"\ndescription = \"A case of vitriol extremes.\"\nmodel = {model:?}\n\
             origin = {:?}\n[scale]\nspacing = {d:?}\nsupport_ratio = {:?}\nframe_time = {:?}\ngravity = {:?}\n\
             rest_density = {:?}\nlength_scale = {:?}\nboundary_spacing_ratio = 0.5\n\
             [solver]\nsubsteps = {}\niterations = {}\nrelaxation = \"{relaxation}\"\nomega = {:?}\n\
             carry_rate = {:?}\nv_max = {:?}\nboundary = \"{walls}\"\nviscosity = {:?}\nsleep = {}\n",
            self.origin,
            self.support_ratio,
            self.frame_time,
            self.gravity,
            self.rest_density,
            self.length_scale,
            self.substeps,
            self.iterations,
            self.omega,
            self.carry_rate,
            self.v_max,
            self.viscosity,
            // In water and physical chemistry (10 substeps), unless an extreme makes the number odd; not in the paper's world (3). A draw of its
            // own would change all cases.
            self.substeps.is_multiple_of(2),
        );
        let angle = match self.surface() {
            None => String::new(),
            Some([tension, angle]) => {
                t += &format!("surface_tension = {tension:?}\n");
                format!("contact_angle = {angle:?}\n")
            }
        };
        let [d_t, d_c] = self.diffusivities();
        t += &match self.base {
            Base::Water => String::new(),
            Base::Paper => format!(
                "[paper]\nT_a = 20.0\nT_B = {:?}\nk_d = 0.017\nk_v = {:?}\nD_T = {d_t:?}\n\
                 D_c = {d_c:?}\n",
                self.boiling_point, self.k_v
            ),
            // Liquid that boils more strongly has more nuclei.
            Base::Physical => format!(
                "[physical]\nambient = 20.0\nmixing = {:?}\neddy_width = 0.006\nlamella = 0.0003\n\
                 nuclei_spacing = {:?}\nmost_bubbles = 4096\nglass_loss = 12.0\nsurface_loss = 12.0\n",
                0.041 * self.diffusion,
                0.04 / self.k_v.max(1e-3).cbrt()
            ),
        };
        let [x, y, z] = self.place;
        let [fx, fy, fz] = self.flask_position();
        let roll = if self.upside_down { 180.0 } else { 0.0 };
        let (height, radius) = (self.height * d, self.radius * d);
        // The table is wider than any flask here.
        let side = (2.0 * (self.radius + 60.0)) * d;
        t += &format!(
            "[table]\ntop = {:?}\ncentre = [{x:?}, {z:?}]\nsize = [{side:?}, {side:?}]\n\
             [floor]\nheight = {y:?}\n\
             [[flask]]\nname = \"glass\"\npoints = [[0.0, {radius:?}], [{height:?}, {radius:?}]]\n\
             wall = {:?}\nposition = [{fx:?}, {fy:?}, {fz:?}]\nrotation = [0.0, 0.0, {roll:?}]\n\
             fixed = {}\n{angle}",
            y + TABLE * d,
            WALL * d,
            self.upside_down,
        );
        let halves = match self.particles {
            Some(count) => [count / 2, count - count / 2].map(|n| format!("particles = {n}")),
            None => ["fraction = 0.5".to_owned(), "fraction = 0.5".to_owned()],
        };
        let acids = if self.base == Base::Water {
            [0.0; 2]
        } else {
            [0.98, 0.0]
        };
        for ((amount, temperature), acid) in halves.iter().zip(self.temperatures).zip(acids) {
            t += &format!(
                "[[liquid]]\nflask = \"glass\"\n{amount}\ntemperature = {temperature:?}\n\
                 acid_fraction = {acid:?}\n"
            );
        }
        t
    }

    /// Depth of the liquid in the flask, m.
    pub fn depth(&self) -> f64 {
        let full = self.height * self.spacing;
        match self.particles {
            Some(count) => {
                let area = PI * self.radius * self.radius;
                (f64::from(count) / area * self.spacing).min(full)
            }
            None => full,
        }
    }
}

/// Wall and height of the table's top over d.
const WALL: f64 = 0.8;
const TABLE: f64 = 100.0;
