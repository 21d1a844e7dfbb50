/// How far a particle may be from where it was listed, metres: the list of one that went further would lack too much.
override LIST_REACH: f32 = 0.000375;
