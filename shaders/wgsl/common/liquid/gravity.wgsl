/// Gravity's magnitude, m/s².
override GRAVITY: f32 = 9.81;
