//! The remote driver's client: packets of 376 bytes, little-endian, over TCP
//! (Monado 25.0.0, `drivers/remote/r_interface.h`, struct `r_remote_data`).

use std::io::{Read, Result, Write};
use std::net::{Ipv4Addr, TcpStream};

use glam::{Quat, Vec3};

use crate::wait::PATIENCE;

const BYTES: usize = 376;
const MAGIC: &[u8; 8] = b"mndrmt3\0";
const HEAD: usize = 104;
const CONTROLLERS: [usize; 2] = [136, 256];

/// One controller, which Monado shows as an Index controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controller {
    /// Position in the stage, m.
    pub position: Vec3,
    /// Orientation in the stage.
    pub orientation: Quat,
    /// Trigger, 0 to 1.
    pub trigger: f32,
    /// Squeeze, 0 to 1.
    pub squeeze: f32,
    /// Thumbstick, x and y.
    pub thumbstick: [f32; 2],
    /// Button A.
    pub a: bool,
    /// Button B.
    pub b: bool,
    /// Whether it is switched on.
    pub active: bool,
}

impl Default for Controller {
    /// Switched on, at the origin, with nothing pressed.
    fn default() -> Self {
        Self {
            position: Vec3::ZERO,
            orientation: Quat::IDENTITY,
            trigger: 0.0,
            squeeze: 0.0,
            thumbstick: [0.0; 2],
            a: false,
            b: false,
            active: true,
        }
    }
}

/// A connection that sets Monado's head and hands. [`Remote::send`] sends the values.
pub struct Remote {
    stream: TcpStream,
    packet: [u8; BYTES],
}

impl Remote {
    /// Connects, and takes over the state that the driver sends first.
    pub(super) fn try_open(port: u16) -> Result<Self> {
        let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port))?;
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.set_nodelay(true)?;
        let mut packet = [0; BYTES];
        // It is sent twice.
        stream.read_exact(&mut packet)?;
        stream.read_exact(&mut packet)?;
        // Only a client's packets need it.
        packet[..MAGIC.len()].copy_from_slice(MAGIC);
        Ok(Self { stream, packet })
    }

    /// Sets the head's pose in the stage: position in m.
    pub fn head(&mut self, position: Vec3, orientation: Quat) {
        self.pose(HEAD, position, orientation);
    }

    /// Sets the left (0) or the right (1) controller.
    pub fn controller(&mut self, side: usize, state: &Controller) {
        let at = CONTROLLERS[side];
        self.pose(at, state.position, state.orientation);
        // Velocities of 0: the driver does not predict.
        self.floats(at + 28, &[0.0; 6]);
        self.floats(at + 52, &[state.squeeze; 5]);
        let [x, y] = state.thumbstick;
        let values = [
            state.trigger,
            state.squeeze,
            state.squeeze,
            x,
            y,
            0.0,
            0.0,
            0.0,
        ];
        self.floats(at + 72, &values);
        // Hand tracking, active, system, a, b, trigger, thumbstick (click and touch each), trackpad.
        let pressed = state.trigger > 0.9;
        let flags = [
            false,
            state.active,
            false,
            false,
            state.a,
            state.a,
            state.b,
            state.b,
            pressed,
            state.trigger > 0.0,
            false,
            false,
            false,
        ];
        for (byte, flag) in self.packet[at + 104..].iter_mut().zip(flags) {
            *byte = flag.into();
        }
    }

    /// Sends the state as it is set now.
    ///
    /// # Errors
    /// The service is gone.
    pub fn send(&mut self) -> Result<()> {
        self.stream.write_all(&self.packet)
    }

    /// Writes a pose: quaternion x y z w, then position.
    fn pose(&mut self, at: usize, position: Vec3, orientation: Quat) {
        self.floats(at, &orientation.to_array());
        self.floats(at + 16, &position.to_array());
    }

    fn floats(&mut self, at: usize, values: &[f32]) {
        for (place, value) in self.packet[at..].chunks_exact_mut(4).zip(values) {
            place.copy_from_slice(&value.to_le_bytes());
        }
    }
}
