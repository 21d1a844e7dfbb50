//! The scenes that a session offers.

/// The order in which acid and water meet in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The correct one: the acid comes to the water.
    Correct,
    /// The incorrect one: the water comes to the acid.
    Incorrect,
    /// The scene teaches neither.
    Neither,
}

/// A scene that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Its key.
    pub key: char,
    /// Name of the scene.
    pub scene: &'static str,
    /// The order that it shows.
    pub order: Order,
    /// Name of the scene that shows the other order; `None` where there is none.
    pub counterpart: Option<&'static str>,
    /// Whether a student's panel offers it; others are the paper's, for an instructor and the keys.
    pub on_panel: bool,
}

/// The scenes, those of the panel first.
pub const CHOICES: [Choice; 11] = [
    choice('1', "acid-into-water").correct("water-into-acid"),
    choice('2', "water-into-acid").incorrect("acid-into-water"),
    choice('3', "fume-hood"),
    choice('4', "acid-on-glove"),
    choice('5', "two-flasks"),
    choice('6', "three-flasks"),
    choice('7', "layer-and-swirl-right").correct("layer-and-swirl"),
    choice('8', "layer-and-swirl").incorrect("layer-and-swirl-right"),
    // It is in no pair, since no scene pours hot acid in the correct order. A second toggle leads to `water-into-acid`.
    choice('9', "hot-acid").incorrect("acid-into-water"),
    choice('0', "triple-dilution").off_panel(),
    choice('p', "vr-dilution").off_panel(),
];

const fn choice(key: char, scene: &'static str) -> Choice {
    Choice {
        key,
        scene,
        order: Order::Neither,
        counterpart: None,
        on_panel: true,
    }
}

/// The scenes that a student's panel offers.
pub fn on_panel() -> impl Iterator<Item = &'static Choice> {
    CHOICES.iter().filter(|choice| choice.on_panel)
}

impl Choice {
    const fn correct(self, counterpart: &'static str) -> Self {
        Self {
            order: Order::Correct,
            counterpart: Some(counterpart),
            ..self
        }
    }

    const fn off_panel(self) -> Self {
        Self {
            on_panel: false,
            ..self
        }
    }

    const fn incorrect(self, counterpart: &'static str) -> Self {
        Self {
            order: Order::Incorrect,
            counterpart: Some(counterpart),
            ..self
        }
    }

    /// What follows its key or title: a sign that says the order by its shape. Nothing for a student whose lesson asks for the order.
    pub fn sign(&self, in_lesson: bool) -> &'static str {
        match self.order {
            _ if in_lesson => "",
            Order::Correct => " ✔",
            Order::Incorrect => " ✖",
            Order::Neither => "",
        }
    }
}

/// The choice of a scene of that name; `None` where it cannot be chosen.
fn of(scene: &str) -> Option<&'static Choice> {
    CHOICES.iter().find(|choice| choice.scene == scene)
}

/// Index of a scene of that name in [`CHOICES`].
pub fn index(scene: &str) -> Option<u8> {
    let at = CHOICES.iter().position(|choice| choice.scene == scene)?;
    u8::try_from(at).ok()
}

/// Name of the scene that shows the other order than `scene`; `None` where there is none.
pub fn counterpart(scene: &str) -> Option<&'static str> {
    of(scene)?.counterpart
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Fume hood and emergency are offered to students, and the paper's scenes are not.
    #[test]
    fn the_panel_offers_what_is_for_students() {
        let offered: Vec<&str> = on_panel().map(|choice| choice.scene).collect();
        assert_eq!(offered.len(), 9);
        assert!(
            ["fume-hood", "acid-on-glove"]
                .iter()
                .all(|it| offered.contains(it))
        );
        assert!(
            !["triple-dilution", "vr-dilution"]
                .iter()
                .any(|it| offered.contains(it))
        );
    }

    /// A scene that teaches an order has a counterpart, which shows the other one.
    #[test]
    fn a_counterpart_shows_the_other_order() {
        for choice in CHOICES {
            let other = match choice.order {
                Order::Correct => Order::Incorrect,
                Order::Incorrect => Order::Correct,
                Order::Neither => {
                    assert_eq!(choice.counterpart, None, "{}", choice.scene);
                    continue;
                }
            };
            let found = of(choice.counterpart.unwrap()).unwrap();
            assert_eq!(found.order, other, "{}", choice.scene);
        }
    }

    #[test]
    fn the_counterpart_of_a_pairs_counterpart_is_itself() {
        for scene in ["acid-into-water", "layer-and-swirl"] {
            let other = counterpart(scene).unwrap();
            assert_ne!(other, scene);
            assert_eq!(counterpart(other), Some(scene));
        }
        assert_eq!(counterpart("hot-acid"), Some("acid-into-water"));
        assert_eq!(counterpart("two-flasks"), None);
        assert_eq!(index("hot-acid"), Some(8));
        // Not one that can be chosen.
        assert_eq!(counterpart("tomato-soup"), None);
    }
}
