//! Rules of OpenXR's best-practice layer, by OpenXR's own dump of the calls to the runtime: a frame is ended for the time that the runtime
//! named for it, and shown with the views that were located last, for that time too.

use std::path::Path;
use std::process::Command;

use glam::{Quat, Vec3};
use vitriol_tests::monado::{self, Remote, Rig};
use vitriol_tests::program::own_name;
use vitriol_xr::{Headset, Shown, View};

use crate::session::client::Client;

/// Where the calls are dumped; set for the instance of the test that makes them.
const DUMP: &str = "XR_API_DUMP_FILE_NAME";

#[test]
fn a_frame_ends_with_its_own_time_and_views() {
    if let Some(dump) = std::env::var_os(DUMP) {
        return draw(Path::new(&dump));
    }
    let Some(rig) = monado::enter(&own_name()) else {
        return;
    };
    // The layer is of a process's environment.
    let layers = "XR_APILAYER_LUNARG_core_validation:XR_APILAYER_LUNARG_api_dump";
    let drawn = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", &own_name(), "--nocapture", "--include-ignored"])
        .env("XR_ENABLE_API_LAYERS", layers)
        .env("XR_API_DUMP_EXPORT_TYPE", "text")
        .env(DUMP, rig.folder().join("dump.txt"))
        .status();
    assert!(drawn.unwrap().success());
}

/// Size of the part of each picture that is drawn, pixels.
const DRAWN: [u32; 2] = [200, 150];

/// Draws frames of a head that moves in each of them, and compares them with their dump.
fn draw(dump: &Path) {
    let mut remote: Remote = Rig::remote_here();
    let mut client = Client::open();
    client.focus();
    let mut drawn = Vec::new();
    for n in 0..12 {
        let (frame, _) = client.frame();
        let time = frame.poses.info.xr_time;
        let head = Vec3::new(0.02 * n as f32, 1.6, 0.1);
        remote.head(head, Quat::from_rotation_y(0.05 * n as f32));
        remote.send().unwrap();
        let targets = client.xr.acquire(true).unwrap().unwrap();
        client.submit(&targets);
        let views = client.hear(head);
        // The frame began with the head where it was before.
        let early = frame.poses.stage_from_view.position;
        assert!(early.distance(head) > 0.01, "frame {n}");
        let shown = Shown {
            extent: DRAWN,
            ..client.shown(views)
        };
        client.xr.end(Some(&shown)).unwrap();
        drawn.push((time, views));
    }
    client.assert_silent();
    drop(client);

    // Buffers that the runtime is to fill are dumped uninitialised.
    let dump = std::fs::read(dump).unwrap();
    let dump = String::from_utf8_lossy(&dump);
    let calls: Vec<&str> = dump.split("XrResult ").collect();
    let shows = |call: &&str| call.starts_with("xrEndFrame") && call.contains("->views[1].pose");
    let ends: Vec<usize> = (0..calls.len()).filter(|&at| shows(&calls[at])).collect();
    let ours = &ends[ends.len() - drawn.len()..];
    for (&end, (time, views)) in ours.iter().zip(&drawn) {
        let ended = calls[end];
        assert_eq!(value(ended, "frameEndInfo->displayTime"), *time as f64);
        for (eye, view) in views.iter().enumerate() {
            assert_eq!(view_of(ended, eye), numbers(view), "at {time}, eye {eye}");
            let shown = ["width", "height"].map(|side| {
                let rect = format!("views[{eye}].subImage.imageRect.extent.{side}");
                value(ended, &format!("frameEndInfo->layers[0]->{rect}"))
            });
            assert_eq!(shown, DRAWN.map(f64::from));
        }
        let last = |name: &str| calls[..end].iter().rposition(|call| call.starts_with(name));
        let begun = last("xrBeginFrame").unwrap();
        // Views are located anew, late: when the images have come.
        assert!(last("xrLocateViews") > last("xrWaitSwapchainImage"));
        let located = calls[begun..end]
            .iter()
            .filter(|call| call.starts_with("xrLocateViews"));
        for call in located {
            assert_eq!(value(call, "viewLocateInfo->displayTime"), *time as f64);
        }
    }
}

/// The number that a call was given under that name. As text of doubles, times are whole to 2^53 ns,
/// three months of a clock that begins with the service.
fn value(call: &str, name: &str) -> f64 {
    let name = format!(" {name} = ");
    let (_, after) = call.split_once(&name).unwrap();
    after.lines().next().unwrap().parse().unwrap()
}

/// Quaternion, position and angles of an eye, as they were handed over.
fn view_of(ended: &str, eye: usize) -> [f32; 11] {
    [
        "pose.orientation.x",
        "pose.orientation.y",
        "pose.orientation.z",
        "pose.orientation.w",
        "pose.position.x",
        "pose.position.y",
        "pose.position.z",
        "fov.angleLeft",
        "fov.angleRight",
        "fov.angleUp",
        "fov.angleDown",
    ]
    .map(|part| {
        let name = format!("frameEndInfo->layers[0]->views[{eye}].{part}");
        value(ended, &name) as f32
    })
}

fn numbers(view: &View) -> [f32; 11] {
    let View {
        stage_from_eye,
        fov,
    } = view;
    let (q, p) = (stage_from_eye.orientation, stage_from_eye.position);
    [
        q.x, q.y, q.z, q.w, p.x, p.y, p.z, fov.left, fov.right, fov.up, fov.down,
    ]
}
