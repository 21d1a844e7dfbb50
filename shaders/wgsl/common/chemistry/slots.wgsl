/// Places for bubbles, in groups of 64.
override SLOTS: u32 = 64u;
