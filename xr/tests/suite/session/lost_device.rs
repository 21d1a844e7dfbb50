//! A Vulkan device that is lost while the runtime stays.

use vitriol_xr::Headset;

use crate::session::client::on_mock;

/// In the middle of a frame, and before one. The frame is not ended; session and device are made anew, and frames go on on another
/// device.
#[test]
fn another_device_is_opened() {
    let Some((mock, mut client)) = on_mock(&[]) else {
        return;
    };
    for round in 0..2 {
        let before = client.xr.gpu().handles().device;
        if round == 0 {
            client.frame();
            client.xr.acquire(true).unwrap().unwrap();
        }
        let lost = client.xr.gpu().clone();
        lost.lose();
        client.xr.lose_device();
        // Later calls in the frame are harmless.
        assert!(client.xr.acquire(true).unwrap().is_none());
        client.xr.end(None).unwrap();
        let (_, others) = client.frame();
        assert!(
            others[0].contains("the Vulkan device was lost"),
            "{others:?}"
        );
        assert!(others.contains(&"renewed".to_owned()), "{others:?}");
        assert!(!client.xr.gpu().is_lost() && lost.is_lost());
        assert_ne!(client.xr.gpu().handles().device, before);
        client.draw();
        client.focus();
    }
    let made = mock.calls_of("xrCreateVulkanDeviceKHR").len();
    assert_eq!(made, 3);
    client.assert_silent();
}
