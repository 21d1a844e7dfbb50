//! What would lose the user's work takes a hold of a second, which shows how far it has come: on three controllers the
//! button for it is the one for the menu.

/// How long, ns.
const LONG: i64 = 1_000_000_000;

/// One hold of a button.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hold {
    /// Display time at which it was pressed, ns.
    since: Option<i64>,
    /// It has been held for long enough, and this was returned.
    done: bool,
}

impl Hold {
    /// Takes in whether it is down at a display time (ns). True once, when it has been for long enough.
    pub fn advance(&mut self, down: bool, now: i64) -> bool {
        if !down {
            *self = Self::default();
            return false;
        }
        let since = *self.since.get_or_insert(now);
        let long = now - since >= LONG;
        long && !std::mem::replace(&mut self.done, long)
    }

    /// How far it has come at that time, 0 to 1; `None` where it is not down, or done.
    pub fn share(&self, now: i64) -> Option<f32> {
        let since = self.since.filter(|_| !self.done)?;
        Some(((now - since) as f64 / LONG as f64).clamp(0.0, 1.0) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_is_a_second() {
        let mut hold = Hold::default();
        let ms = |n: i64| 5_000_000_000 + 1_000_000 * n;
        assert_eq!(hold.share(ms(0)), None);
        assert!(!hold.advance(true, ms(0)));
        assert!(!hold.advance(true, ms(500)));
        assert_eq!(hold.share(ms(500)), Some(0.5));
        // Let go and pressed again it begins anew.
        assert!(!hold.advance(false, ms(900)));
        assert!(!hold.advance(true, ms(901)));
        assert!(!hold.advance(true, ms(1900)));
        assert!(hold.advance(true, ms(1901)));
        // Once.
        assert!(!hold.advance(true, ms(5000)));
        assert_eq!(hold.share(ms(5000)), None);
    }
}
