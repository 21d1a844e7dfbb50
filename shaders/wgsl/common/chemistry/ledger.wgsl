// The record `ledger` of the physical chemistry, by identity: what a particle paid, took and gave since the
// start, in J and kg per V0·ρ0.

struct Account {
    /// Kinetic energy that boiling was paid for.
    kinetic: f32,
    /// Heat gained from what is around.
    heat: f32,
    /// Mass of the steam that left, and its enthalpy.
    steam: vec2<f32>,
}

/// Place of `kinetic` in the record.
const KINETIC = 0u;

fn pack_account(account: Account) -> vec4<f32> {
    return vec4<f32>(account.kinetic, account.heat, account.steam);
}

fn unpack_account(words: vec4<f32>) -> Account {
    return Account(words.x, words.y, words.zw);
}
