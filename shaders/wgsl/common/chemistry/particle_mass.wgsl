/// Mass of a particle at rest density, kg.
override MASS: f32 = 1e-5;
