//! What is seen of a thermometer's stem: a plate with marks and numbers, and the column before it, as inside glass.
//!
//! The plate stands on the axis and is turned to the eye, so that it is read from wherever one stands; who rolls a thermometer in
//! her hand sees nothing turn. Column and marks are both on it, so that there is no parallax between them: who looks from above
//! reads what who looks from the side does. The glass bends nothing.
//!
//! Across it runs from −1 to 1, the glass's edges: the column, marks to its right, and numbers that are read from the bulb
//! upwards. Lengths are over the glass's radius.

//!include common/picture/digits.wgsl
//!include common/picture/glove_surface.wgsl

/// Reflectance of white enamel, of ink, and of dyed spirit as in the bulb (`Finish::Column`).
const PLATE = vec3<f32>(0.70, 0.70, 0.67);
const MARK_INK = vec3<f32>(0.02);
const SPIRIT = vec3<f32>(0.450, 0.020, 0.020);
/// Half of the plate's width, and how far it goes beyond the last marks, °C.
const PLATE_HALF = 0.94;
const PLATE_OVER = vec2<f32>(2.0, 5.0);
/// Middle and half of the column; and how much darker the empty bore is than the plate.
const COLUMN_AT = -0.62;
const COLUMN_HALF = 0.19;
const BORE = 0.75;
/// Where marks begin, and where those of one, five and ten degrees end; half of their widths.
const MARKS_BEGIN = -0.38;
const MARKS_END = vec3<f32>(-0.20, -0.10, 0.04);
const MARK_HALF = vec3<f32>(0.035, 0.035, 0.055);
/// Where the numbers' upper edge is, and their height; one stands each so many degrees.
const FIGURES_AT = 0.12;
const FIGURE_HEIGHT = 0.76;
const FIGURES_EACH = 20.0;

/// How much of a pixel lies inside an edge that is so far away.
fn inside_edge(away: f32, pixel: f32) -> f32 {
    return saturate(away / pixel + 0.5);
}

/// The ink at a place of the plate; `degree` is how long one is.
fn scale_ink(x: f32, celsius: f32, degree: f32, pixel: f32) -> f32 {
    let nearest = clamp(round(celsius), run.scale_low, run.scale_high);
    let n = i32(nearest);
    let kind = select(select(0u, 1u, n % 5 == 0), 2u, n % 10 == 0);
    let half = MARK_HALF[kind];
    let line = inside_edge(half - abs(celsius - nearest) * degree, pixel) * min(1.0, 2.0 * half / pixel);
    let mark = line * inside_edge(min(x - MARKS_BEGIN, MARKS_END[kind] - x), pixel);
    // Letters lie on their sides.
    let point = FIGURE_HEIGHT / LETTER.y;
    let figure = round(celsius / FIGURES_EACH) * FIGURES_EACH;
    let down = (x - FIGURES_AT) / point;
    var print = 0.0;
    if (figure >= 0.0 && figure <= run.scale_high) {
        let number = u32(figure);
        let length_ = LETTER_STEP * f32(digits_of(number)) - 1.0;
        let along = (celsius - figure) * degree / point + 0.5 * length_;
        print = number_ink(number, false, vec2<f32>(along, down), pixel / point);
    }
    let unit = vec2<f32>((celsius - run.scale_high) * degree / point + LETTER_STEP, down);
    print = max(print, letter_ink(LETTER_DEGREE, unit, pixel / point));
    print = max(print, letter_ink(LETTER_C, unit - vec2<f32>(LETTER_STEP, 0.0), pixel / point));
    return max(mark, print);
}

/// The tint at a place on the stem, which else has that of `glass`; `at` and `ray` are from the eye, and a pixel is `width` wide there.
fn stem_tint(stem: Cone, at: vec3<f32>, ray: vec3<f32>, width: f32, glass: vec3<f32>) -> vec3<f32> {
    let from_end = at - stem.end;
    let right = cross(ray, stem.axis);
    let x = dot(from_end, right) / (max(length(right), 1e-6) * stem.radius);
    let pixel = width / stem.radius;
    // From the glass's face on to the plate.
    let facing = cross(right, stem.axis);
    let behind = dot(from_end, facing) / min(dot(ray, facing), -1e-6);
    let celsius = run.scale_low + (dot(from_end - behind * ray, stem.axis) - run.scale_from) / run.scale_degree;
    let degree = run.scale_degree / stem.radius;
    let over = min(celsius - run.scale_low + PLATE_OVER.x, run.scale_high + PLATE_OVER.y - celsius);
    let plate = inside_edge(min(PLATE_HALF - abs(x), over * degree), pixel);
    let bore = inside_edge(COLUMN_HALF - abs(x - COLUMN_AT), pixel);
    let filled = inside_edge((run.reading - celsius) * degree, pixel);
    var tint = mix(glass, mix(PLATE, MARK_INK, scale_ink(x, celsius, degree, pixel)), plate);
    tint = mix(tint, BORE * tint, bore * plate);
    return mix(tint, SPIRIT, bore * filled);
}
