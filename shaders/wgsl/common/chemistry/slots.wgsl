/// Places for bubbles, in groups of 64.
override SLOTS: u32 = 64u;
/// Whether what bubbles throw up is followed.
override SPRAY: bool = false;
