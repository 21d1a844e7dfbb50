/// How far a particle may be from where it was listed, metres: one that went further might miss neighbours.
override LIST_REACH: f32 = 0.000375;
