//! What is printed on a vessel: graduation marks in blue enamel, a number beside every long one, and a paper label.

//!include common/picture/daylight.wgsl
//!include common/picture/digits.wgsl
//!include common/picture/frame.wgsl

/// Two a segment of an outline: (r, y) of its ends, and the outward normals (r, y) there. A closed outline goes
/// up outside, over the rim, and down inside. Then a mark each, see `Mark`, and two rows of a label, see `labelled`.
@group(0) @binding(5) var<storage, read> outlines: array<vec4<f32>>;

/// Reflectance of blue enamel, as graduated cylinders have it, which is darker than any bench; of paper, and of ink.
const ENAMEL = vec3<f32>(0.020, 0.045, 0.110);
const PAPER = vec3<f32>(0.72);
const INK = vec3<f32>(0.03);
/// Angles from +Z towards +X between which marks and numbers are, and where numbers begin.
const MARKS_FROM = -0.25;
const MARKS_TO = 1.1;
const NUMBERS_FROM = 0.27;
/// Height of a digit over the vessel's radius.
const DIGIT_HEIGHT = 0.13;

/// A graduation mark.
struct Mark {
    height: f32,
    /// Half of its angle about +Z.
    half_angle: f32,
    /// Half of its strip's width; half of the strip is the line.
    half_width: f32,
    /// The volume up to it as it is printed, mL, and a half more where the unit is printed too; 0 for none.
    number: f32,
}

fn unpack_mark(words: vec4<f32>) -> Mark {
    return Mark(words.x, words.y, words.z, words.w);
}

/// What is printed at a place: its colour as displayed, and the share of what is behind that is still seen.
struct Print {
    colour: vec3<f32>,
    open: f32,
}

/// What is printed at a place before it is known how much ink a letter has there.
struct Written {
    letter: LineLetter,
    /// A pixel's width in the letter's points.
    pixel: f32,
    /// The share of a label's paper.
    paper: f32,
}

/// What is written on a label of two rows: the first has the height of its lower edge, that of its letters, the angle of its middle and half
/// its angle, and the second two lines of letters. Its lines are one over the other, in four thirds of their height each.
fn labelled(row: u32, p: vec3<f32>, radius: f32, angle: f32, width: f32) -> Written {
    let shape = outlines[row];
    let text = outlines[row + 1u];
    let point = shape.y / LETTER.y;
    let lines = select(1.0, 2.0, text.z > 0.0);
    let high = shape.y * (0.7 + 1.4 * lines);
    let aside = (angle - shape.z) * radius;
    let half = shape.w * radius;
    let up = p.y - shape.x;
    let edge = min(half - abs(aside), min(up, high - up));
    let paper = saturate(edge / width + 0.5);
    if (paper == 0.0) { return Written(NO_LETTER, 1.0, 0.0); }
    let at = vec2<f32>(aside + half - 0.7 * shape.y, high - up - 0.7 * shape.y) / point;
    let second = at.y - 1.4 * LETTER.y;
    let codes = select(text.xy, text.zw, second > -1.0);
    return Written(line_letter(codes, vec2<f32>(at.x, select(at.y, second, second > -1.0))), width / point, paper);
}

/// What is printed at p on a vessel's outside. One letter alone is asked for its ink, because a software driver walks that code once for each call.
/// The vessel's normal (stage) faces the eye there, from before if `front`; `width` is a pixel's height.
fn printed(vessel: u32, p: vec3<f32>, front: bool, width: f32, normal: vec3<f32>, stage: vec3<f32>) -> Print {
    let angle = atan2(p.x, p.z);
    let radius = length(p.xz);
    var covered = 0.0;
    let range = frame.vessels[vessel].marks;
    let end = select(range.x, range.y, angle > MARKS_FROM && angle < MARKS_TO);
    let digit = DIGIT_HEIGHT * frame.vessels[vessel].outer;
    let point = digit / LETTER.y;
    // The number that is nearest, and how far up from its middle.
    var number = 0.0;
    var above = 0.6 * digit;
    for (var index = range.x; index < end; index++) {
        let mark = unpack_mark(outlines[index]);
        let up = p.y - mark.height;
        let is_beside = abs(angle) >= mark.half_angle;
        let across = abs(up) / mark.half_width;
        // A pixel wider than the line has its share of it.
        let pixel = max(width / mark.half_width, 1e-6);
        let share = saturate((0.5 - across) / pixel + 0.5) * min(1.0, 1.0 / pixel);
        covered = max(covered, select(share, 0.0, is_beside || across > 1.0));
        let is_nearest = is_beside && mark.number > 0.0 && abs(up) < abs(above);
        number = select(number, mark.number, is_nearest);
        above = select(above, up, is_nearest);
    }
    var written = Written(NO_LETTER, width / point, 0.0);
    if (number > 0.0) {
        let at = vec2<f32>((angle - NUMBERS_FROM) * radius, 0.5 * digit - above) / point;
        written.letter = number_letter(u32(number), fract(number) > 0.25, at);
    }
    let label = frame.vessels[vessel].label;
    if (label > 0u && angle < 0.0) { written = labelled(label, p, radius, angle, width); }
    let ink = letter_ink(written.letter.code, written.letter.at, written.pixel);
    let is_paper = written.paper > 0.0;
    let albedo = mix(ENAMEL, mix(PAPER, INK, select(0.0, ink, front)), written.paper);
    covered = max(covered, select(ink, written.paper, is_paper));
    if (covered == 0.0) { return Print(vec3<f32>(0.0), 1.0); }
    let key = key_light(stage * frame.metres_per_unit);
    let lit = albedo * (ambient_light(normal.y) + max(dot(normal, key.direction), 0.0) * key.light);
    return Print(display(lit) * covered, 1.0 - covered);
}
