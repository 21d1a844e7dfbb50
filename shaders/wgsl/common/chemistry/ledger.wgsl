// The record `ledger` of the physical chemistry, by identity: what a particle took and gave since the start, in J and
// kg per V0·ρ0.

struct Account {
    /// Heat gained from what is around.
    heat: f32,
    /// Mass of the steam that left, and its enthalpy.
    steam: vec2<f32>,
}

fn pack_account(account: Account) -> vec4<f32> {
    return vec4<f32>(account.heat, account.steam, 0.0);
}

fn unpack_account(words: vec4<f32>) -> Account {
    return Account(words.x, words.yz);
}
