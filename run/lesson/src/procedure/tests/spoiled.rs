//! Lessons with a mistake, and the messages about it: file, field, and what would be right.

use super::fits::facts;
use super::*;
use crate::Language;

/// A lesson that has each thing that a test spoils once.
pub(super) const GOOD: &str = r#"
version = 1
name = "own-1"
scene = "bench"
modes = ["guided", "free"]

[[step]]
id = "pour"
points = 10
hint_after_s = 20
time_limit_s = 120
keep = [{ cool = { flask = "b", below_c = 60 } }, "gloves"]
[step.condition.poured]
from = "a"
into = "b"
liquid = "acid"
at_least_ml = 15
at_most_ml = 20
at_most_ml_s = 5

[[step]]
id = "stir"
after = ["pour"]
points = 5
condition = { all = [{ stirred = { flask = "b", at_least_s = 5 } }, { any = [{ lifted = { flask = "a" } }, { goggles = { on = true } }] }] }

[[step]]
id = "check"
points = 0
[step.condition.holds]
flask = "b"
at_least_ml = 170
acid_from_percent = 15
acid_to_percent = 20
for_s = 3

[[step]]
id = "look"
points = 0
condition = { temperature = { flask = "b", at_least_c = 20, at_most_c = 90 } }

[[rule]]
id = "clean"
points = 5
keep = { spilt = { at_most_ml = 1 } }

[texts.en]
title = "Own"
summary = "What it is about."
step.pour = { text = "Pour.", hint = "Slowly." }
step.stir = { text = "Stir.", hint = "Take the rod." }
step.check = { text = "Check.", hint = "Wait." }
step.look = { text = "Look.", hint = "There." }
rule.clean = "Spill nothing."

[texts.zh]
title = "自己的"
summary = "说明。"
step.pour = { text = "倒。", hint = "慢慢。" }
step.stir = { text = "搅拌。", hint = "拿玻璃棒。" }
step.check = { text = "检查。", hint = "等待。" }
step.look = { text = "看。", hint = "那里。" }
rule.clean = "不要洒出。"
"#;

/// What spoils it => by what => what is told. `{61 x}` and `{141 长}` are texts that are too long by a character.
const SPOILED: &str = r#"
hint = "Wait." => hint = "Wait.", hint_desk = "" => texts.en.step.check.hint_desk: empty
version = 1 => version = 2 => version: 2 | reads 1
version = 1 =>  => missing field `version`
version = 1 => version = 1.5 => line 2 | `1.5` does not fit
modes = [ => modes =  => line 5
name = "own-1" => name = "Own lesson" => name: | "Own lesson" | a to z
scene = "bench" => scene = " " => scene: | name a scene
scene = => scenes = => line 4 | unknown field `scenes` | `scene`
["guided", "free"] => ["guided", "guided"] => modes: | twice | "free"
["guided", "free"] => [] => modes: | "examination"
["guided", "free"] => ["exam"] => line 5 | unknown variant `exam` | `examination`
id = "stir" => id = "pour" => step 2, id: | "pour" is there before
id = "clean" => id = "stir" => rule 1, id: | "stir" is there before
id = "stir" => id = "" => step 2, id: | no name
after = ["pour"] => after = ["check"] => step 2, after: | "check" | "pour"
points = 10 => points = 1001 => step 1, points: 1001 | 0 to 1000
points = 10 => points = -1 => line 9 | `-1` does not fit
hint_after_s = 20 => hint_after_s = 0 => step 1, hint_after_s: 0 | 1 to 3600
time_limit_s = 120 => time_limit_s = inf => step 1, time_limit_s: inf
time_limit_s = 120 => time_limit = 120 => line 11 | `time_limit` | `time_limit_s`
[step.condition.poured] => [step.condition.pored] => unknown variant `pored` | `poured` | `put-down` | `rinsed`
at_least_ml = 15 => at_least_ml = 0.1 => step 1, condition.poured.at_least_ml: 0.1 | 0.5 to
at_least_ml = 15 => at_least_ml = nan => step 1, condition.poured.at_least_ml: NaN
at_least_ml = 15 =>  => missing field `at_least_ml`
at_most_ml = 20 => at_most_ml = 10 => step 1, condition.poured: | at_least_ml 15 is above at_most_ml 10
at_most_ml_s = 5 => at_most_ml_s = 0 => step 1, condition.poured.at_most_ml_s: 0 | 0.1 to 1000
liquid = "acid" => liquid = "base" => unknown variant `base` | `any`, `acid`, `water`
acid_to_percent = 20 => acid_to_percent = 10 => step 3, condition.holds.acid_to_percent: 10 | 15 to 100
acid_from_percent = 15 => acid_from_percent = 0.15e9 => acid_from_percent: 150000000 | 0 to 100
for_s = 3 => for_s = 0 => step 3, condition.holds.for_s: 0
at_least_s = 5 => at_least_s = -5 => step 2, condition.all 1, stirred.at_least_s: -5
at_least_c = 20, at_most_c = 90 => at_least_c = 90, at_most_c = 20 => step 4, condition.temperature: | the other way
, at_least_c = 20, at_most_c = 90 =>  => step 4, condition.temperature: | has no end
at_most_c = 90 => at_most_c = 900 => step 4, condition.temperature.at_most_c: 900 | -50 to 350
any = [{ lifted = { flask = "a" } }, { goggles = { on = true } }] => any = [] => step 2, condition.all 2, any: | 0 parts
{ goggles = { on = true } } => { any = [{ all = [] }] } => step 2, condition.all 2, any 2, any: | deep | two steps
below_c = 60 => below_c = 1e9 => step 1, keep 1, cool.below_c:
"gloves"] => "glove"] => unknown variant `glove` | `gloves`
at_most_ml = 1 } => at_most_ml = -1 } => rule 1, keep.spilt.at_most_ml: -1
spilt = { => spilled = { => unknown variant `spilled` | `spilt`
title = "Own" =>  => missing field `title`
title = "Own" => title = "{61 x}" => texts.en.title: 61 | room for 60
title = "Own" => title = " " => texts.en.title: empty
title = "Own" => title = "a\nb" => texts.en.title: | line break
title = "Own" => title = "Own {flask}" => texts.en.title: | brace | no holes
summary = "说明。" => summary = "{141 长}" => texts.zh.summary: 141 | room for 140
step.stir = { text = "搅拌。", hint = "拿玻璃棒。" } =>  => texts.zh.step.stir: missing
rule.clean = "不要洒出。" =>  => texts.zh.rule.clean: missing
step.look = { text = "看。", hint = "那里。" } => step.look = { text = "看。", hint = "那里。" }⏎step.lok.text = ""⏎step.lok.hint = "" => texts.zh.step.lok: | "look"
hint = "Slowly." => hints = "Slowly." => unknown field `hints` | `hint`
[texts.zh] => [texts.fr] => unknown field `fr` | `en` | `zh`
"#;

#[test]
fn a_spoiled_lesson_names_file_field_and_remedy() {
    Lesson::parse_for(GOOD, ("good.toml", Language::En), |_| Ok(Some(facts()))).unwrap();
    let table = SPOILED.replace("{61 x}", &"x".repeat(61));
    let table = table.replace("{141 长}", &"长".repeat(141));
    assert_each_is_refused(GOOD, &table);
    Lesson::parse(&GOOD.replacen("points = 10", "points = 0", 1), "good.toml").unwrap();
    let none = GOOD
        .replace("points = 10\n", "points = 0\n")
        .replace("points = 5\n", "points = 0\n");
    let error = Lesson::parse(&none, "bad.toml").unwrap_err().to_string();
    assert!(
        error.contains("step 1, points") && error.contains("give one some"),
        "{error}"
    );
    let empty = "version = 1\nname = \"a\"\nscene = \"b\"\nmodes = [\"free\"]\n";
    let error = Lesson::parse(empty, "bad.toml").unwrap_err().to_string();
    assert!(
        error.contains("step: there are 0") && error.contains("1 to 50"),
        "{error}"
    );
    let step = |n| {
        format!(
            "[[step]]\nid = \"s{n}\"\npoints = 1\ncondition = {{ goggles = {{ on = true }} }}\n"
        )
    };
    let many = empty.to_owned() + &(0..51).map(step).collect::<String>();
    let error = Lesson::parse(&many, "bad.toml").unwrap_err().to_string();
    assert!(error.contains("step: there are 51"), "{error}");
}
