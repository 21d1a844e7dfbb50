// What the scene asks of the liquid's chemistry. The program has two: the paper's, and the physical one
// (`chemistry/paper.rs`, `chemistry/physical.rs`).

/// Whether particles have a temperature and an acid fraction, by either chemistry.
override HEAT: bool = false;
/// Whether the chemistry is the physical one.
override PHYSICAL: bool = false;
/// Paper: whether heat and acid diffuse, and heat of solution arises (line 26).
override DILUTION: bool = false;
/// Paper: whether what boils stirs the liquid (line 27).
override BOILING: bool = false;
/// Physical: whether volume and density follow composition and temperature.
override DENSITY: bool = false;
/// Physical: whether viscosity does.
override VISCOSITY: bool = false;
/// Physical: whether water boils out of the liquid and condenses in it, and evaporates at its surface.
override EVAPORATION: bool = false;
/// Physical: whether liquid stays unmixed below a particle's size.
override SEGREGATION: bool = false;
/// Physical: whether heat is lost to glass and air.
override LOSSES: bool = false;
/// Physical: whether vapour is in bubbles that have volume.
override BUBBLES: bool = false;
/// Physical: whether streams take air down.
override AIR: bool = false;
