"""The room's light, as `shaders/wgsl/common/picture/{daylight,room}.wgsl` has it.

All radiances are linear Rec. 709. What the shaders call ambient light and the window's light are irradiances over pi,
so a diffuse surface sends back its albedo times their sum. `check.py` compares the constants with the shaders' text.

What the truth makes of it:

- The ambient light is a hemisphere of CEILING above and one of FLOOR below, infinitely far away. On a surface without
  anything before it, that is the shader's `ambient_light` exactly. Walls and ceiling are seen by the eye, by mirrors and
  through liquid, but keep no light away: the two hemispheres stand for all that they send on.
- The window is four panes about WINDOW, on the wall. Their radiance is the shaders' `PANE_LIGHT`, in the
  key light's colour. Their size is such that the irradiance at BENCH is that of `key_light`; it comes out
  as the shaders' `WINDOW_HALF`. Elsewhere the unshadowed
  irradiance is taken from `key_light`, and what part of it arrives from rays to the panes.
- Mirrors and refraction see the same room as the eye does.
"""

import numpy as np

WINDOW = np.array([-1.6, 1.75, 0.35])
WINDOW_POWER = np.array([7.855, 7.643, 7.324])
CEILING = np.array([0.52, 0.55, 0.60])
FLOOR = np.array([0.24, 0.22, 0.20])
ALBEDO_WALL = np.array([0.62, 0.60, 0.56])
ALBEDO_FLOOR = np.array([0.20, 0.19, 0.18])
ALBEDO_TABLE = np.array([0.30, 0.33, 0.35])

# Where vessels stand on the bench, m: there the panes' irradiance is the key light's.
BENCH = np.array([0.0, 0.75, -0.40])
UP = np.array([0.0, 1.0, 0.0])
# `PANE_LIGHT`, green.
PANE_RADIANCE = 9.0
# Half width and height of the window over the way to it, and half the bars' width, as they were chosen.
PANE_SHAPE = np.array([1.0, 0.68])
BARS = 0.03

# What 60 mm of water and of acid let through (`render/src/tints.rs`), as absorption in 1/m.
TINT_PATH = 0.06
WATER = -np.log(np.array([0.40, 0.74, 0.92])) / TINT_PATH
ACID = -np.log(np.array([0.96, 0.70, 0.22])) / TINT_PATH

AIR, GLASS, LIQUID = 0, 1, 2
# Borosilicate glass and water at 20 °C, as the shaders have them.
INDEX_GLASS = 1.47
INDEX_WATER = 1.333


def key_light(at):
    """The window's light on a surface that faces it at `at` (m): direction, irradiance over pi."""
    way = WINDOW - at
    square = np.sum(way * way, axis=-1, keepdims=True)
    return way / np.sqrt(square), WINDOW_POWER / (1.0 + square)


def ambient_light(up):
    """Irradiance over pi of the hemispheres on a normal with the upward part `up`."""
    share = (0.5 + 0.5 * np.asarray(up))[..., None]
    return FLOOR * (1.0 - share) + CEILING * share


def window_axes():
    """Along the window's width and height, and out of it, into the room."""
    return np.array([0.0, 0.0, -1.0]), np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])


def panes():
    """Half width and height of the window, m, half the bars' width, m, and the panes' radiance."""
    radiance = PANE_RADIANCE * WINDOW_POWER / WINDOW_POWER[1]
    direction, light = key_light(BENCH)
    wanted = np.pi * light[1] * direction[1] / radiance[1]
    low, high = 0.1, 5.0
    for _ in range(50):
        size = 0.5 * (low + high)
        half = size * PANE_SHAPE
        if facing(BENCH, UP, half, size * BARS) < wanted:
            low = size
        else:
            high = size
    return half, size * BARS, radiance


def facing(at, normal, half, bars, steps=64):
    """Integral of the cosine over the solid angle of the panes, by a midpoint rule."""
    places = np.linspace(-1, 1, 2 * steps + 1)
    places = 0.5 * (places[1:] + places[:-1])
    u, v = np.meshgrid(places * half[0], places * half[1])
    across, along, out = window_axes()
    way = WINDOW + u[..., None] * across + v[..., None] * along - at
    square = np.sum(way * way, -1)
    cosines = np.maximum(way @ normal, 0.0) * np.maximum(-(way @ out), 0.0) / square
    open_ = (np.abs(u) > bars) & (np.abs(v) > bars)
    area = 4.0 * half[0] * half[1] / u.size
    return np.sum(cosines / square * open_) * area


def display(light):
    """Tone mapping, `display` of the shaders."""
    light = np.maximum(light, 0.0)
    return np.clip(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), 0.0, 1.0)


def encoded(light):
    """sRGB, IEC 61966-2-1."""
    return np.where(light < 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 0.0031308) ** (1 / 2.4) - 0.055)
