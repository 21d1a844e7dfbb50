// Line 27's coefficient as a multiple of the substep's.

/// Coefficient of what does not boil: 1, or 0 where the liquid has no viscosity.
override CALM: f32 = 1.0;

/// ν·Δt/h² that an XSPH coefficient of 1 amounts to: half of the cubic spline's second moment.
const XSPH_MOMENT: f32 = 0.0375;
