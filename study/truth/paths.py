"""Light's paths, on Mitsuba's rays and in its compiled loops.

A path from the eye is bent or mirrored at each surface between air, glass and liquid, by Snell and Fresnel, and dimmed in
liquid by Beer and Lambert, until it meets bench, floor or wall. Bubbles are gas in the liquid, and films where they stand
out of it; balls that overlap are one bubble. What bench, floor and walls send back is taken as in `light.py`: the panes by
a ray to a point of them, all other light by one ray into the hemisphere, which glass and liquid bend as well. So a caustic
is light of the panes that such a ray finds behind glass or liquid.

Mitsuba's own integrators would do, but for the room: its walls are seen and yet keep no light away.
"""

from dataclasses import dataclass

import drjit as dr
import mitsuba as mi
import numpy as np

import light as lights
from light import AIR, GLASS, LIQUID
from tools import bend, colour, cosine_lot, greater, lesser, vector

# Surfaces on a path at most; what goes on after that is lost, and counted.
MOST = 128
# Places on a way through liquid at which its acid is looked up.
STEPS = 4
# How far from a surface a ray begins, m: some ten of single precision's steps, and a small part of `bench.GAP`.
CLEAR = 2e-6
FAR = 1e9


@dataclass
class Options:
    """What is left out, to see what it costs; and what air, glass and liquid are in tests."""

    # False: light of the panes goes straight on through glass and liquid, dimmed, so that there are no caustics.
    caustics: bool = True
    # False: mirrors on the eye's side of the first surface show nothing.
    mirrors: bool = True
    # False: nothing keeps light from bench, floor and walls.
    shadows: bool = True
    tint: bool = True
    index: tuple = (1.0, lights.INDEX_GLASS, lights.INDEX_WATER)
    # What sulfuric acid of 98 % has more than water.
    index_of_acid: float = 0.0975 / 0.98


class Paths:
    """The light of one bench."""

    def __init__(self, bench, options):
        self.bench, self.options = bench, options
        half, bars, radiance = lights.panes()
        self.half, self.bars = half.tolist(), float(bars)
        # Numbers, and not the library's: what a loop meets of those it would carry along.
        self.window = lights.WINDOW.tolist()
        self.across, self.along, self.out = (axis.tolist() for axis in lights.window_axes())
        self.pane_light = radiance.tolist()
        self.acid = None
        if bench.acid is not None:
            share, low, spacing = bench.acid
            # Mitsuba counts x first, and a texture's last axis is its first.
            data = np.ascontiguousarray(share.transpose(2, 1, 0))[..., None]
            self.acid = mi.Texture3f(mi.TensorXf(data), wrap_mode=dr.WrapMode.Clamp)
            self.low, self.cells = (low - 0.5 * spacing).tolist(), (np.array(share.shape) * spacing).tolist()

    def acid_at(self, at):
        if self.acid is None:
            return mi.Float(0.0)
        return self.acid.eval((at - vector(self.low)) / vector(self.cells))[0]

    def dimmed(self, origin, way, length, rng):
        """What a way through liquid lets pass."""
        if not self.options.tint:
            return mi.Color3f(1.0)
        share = mi.Float(0.0)
        if self.acid is not None:
            for step in range(STEPS):
                share += self.acid_at(origin + way * (length * (step + rng.next_float32()) / STEPS)) / STEPS
        absorbed = colour(lights.WATER) * (1.0 - share) + colour(lights.ACID) * share
        return dr.exp(-absorbed * length)

    def is_shape(self, found, name):
        shape = self.bench.shapes.get(name)
        return mi.Bool(False) if shape is None else found.shape == mi.ShapePtr(shape)

    def sides(self, found, way):
        """The media before and behind what was found, whether it is bench, whether a bubble's face, and that from outside, and its
        normals, which face the ray. Of a bubble's face the media are not told."""
        names = ("air_liquid", "glass_liquid", "air_glass", "air_bubble", "spray")
        wet, lined, glass, bubble, spray = (self.is_shape(found, name) for name in names)
        wet |= spray
        smooth = found.sh_frame.n
        flat = found.n * dr.select(dr.dot(found.n, smooth) < 0.0, -1.0, 1.0)
        outside = dr.dot(way, flat) < 0.0
        # Normals point into `out`, away from `inner`.
        out = dr.select(lined, mi.UInt(LIQUID), mi.UInt(AIR))
        inner = dr.select(wet, mi.UInt(LIQUID), mi.UInt(GLASS))
        before, behind = dr.select(outside, out, inner), dr.select(outside, inner, out)
        sign = dr.select(outside, 1.0, -1.0)
        flat, smooth = flat * sign, smooth * sign
        smooth = dr.select(dr.dot(way, smooth) < -0.01, smooth, flat)
        return before, behind, ~(wet | lined | glass | bubble), bubble, bubble & outside, smooth, flat

    def index(self, medium, at):
        air, glass, water = self.options.index
        of_liquid = water + self.options.index_of_acid * self.acid_at(at)
        return dr.select(medium == AIR, air, dr.select(medium == GLASS, glass, of_liquid))

    def to_panes(self, origin, way):
        """How far it is to the panes, FAR where it goes past them."""
        aside, out = origin - vector(self.window), vector(self.out)
        steep = dr.dot(way, out)
        length = -dr.dot(aside, out) / lesser(steep, -1e-6)
        at = aside + length * way
        u, v = dr.abs(dr.dot(at, vector(self.across))), dr.abs(dr.dot(at, vector(self.along)))
        inside = (u < self.half[0]) & (v < self.half[1]) & (u > self.bars) & (v > self.bars)
        return dr.select(inside & (steep < -1e-6) & (length > 0.0), length, FAR)

    def to_room(self, origin, way):
        """How far it is to the room's inside, and its normal there."""
        low, high = (vector(corner) for corner in self.bench.room)
        steep = dr.select(dr.abs(way) < 1e-9, 1e-9, way)
        ways = (dr.select(steep > 0.0, high, low) - origin) / steep
        length = lesser(ways.x, lesser(ways.y, ways.z))
        normal = dr.select(ways <= length, -dr.sign(steep), 0.0)
        return greater(length, 0.0), dr.normalize(mi.Normal3f(normal))

    @dr.syntax
    def follow(self, origin, way, medium, rng, room, first, straight):
        """Follows rays to their ends.

        `room`: whether walls are met. `first`: None, or whether the first surface mirrors (1) or lets pass (0); then the ray's
        share is in what it carries. `straight`: nothing bends. Gives what is carried, the end's place, normal and
        kind (0 nothing, 1 bench, 2 room, 3 panes), and whether any surface was met, and liquid.
        """
        origin, way, medium = mi.Point3f(origin), mi.Vector3f(way), mi.UInt(medium)
        carried = mi.Color3f(1.0)
        kind, met = mi.UInt(0), mi.UInt(0)
        normal = mi.Normal3f(0.0, 1.0, 0.0)
        wet = mi.Bool(False)
        # Bubbles that the ray is in.
        within = mi.UInt(0)
        going = mi.Bool(True)
        while going:
            found = self.bench.scene.ray_intersect(mi.Ray3f(origin, way))
            hit = found.is_valid()
            length = dr.select(hit, found.t, FAR)
            panes = self.to_panes(origin, way)
            walls, wall_normal = self.to_room(origin, way)
            # The upper panes are above the ceiling, which keeps no light away.
            walls = dr.select((panes < length) | mi.Bool(not room), FAR, walls)
            ends = (panes < length) | (walls < length) | ~hit
            before, behind, bench, bubble, enters, smooth, flat = self.sides(found, way)
            # A bubble's face is in what is around it.
            before, behind = dr.select(bubble, medium, before), dr.select(bubble, medium, behind)
            after = dr.select(enters, within + 1, dr.select(bubble & (within > 0), within - 1, within))
            # At a surface its own side says what was gone through.
            medium = dr.select(ends | bench, medium, before)
            length = lesser(length, lesser(panes, walls))
            dimmed = self.dimmed(origin, way, length, rng)
            carried *= dr.select((medium == LIQUID) & (within == 0) & (length < FAR), dimmed, 1.0)
            wet |= (medium == LIQUID) | (~ends & ~bench & (behind == LIQUID))
            kind = dr.select(ends, dr.select((panes < FAR) & (panes <= length), 3, dr.select(walls < FAR, 2, 0)), dr.select(bench, 1, kind))
            normal = dr.select(ends, wall_normal, dr.select(bench, mi.Normal3f(flat), normal))
            goes_on = ~(ends | bench)
            at = origin + length * way
            film = bubble & (medium == AIR) & ((within == 0) | (after == 0))
            n_before = self.index(dr.select((before == LIQUID) & (within > 0), AIR, before), at)
            n_behind = self.index(dr.select(film, LIQUID, dr.select((behind == LIQUID) & (after > 0), AIR, behind)), at)
            lot = rng.next_float32()
            if first is not None:
                forced = dr.select(mi.Bool(first == 1), mi.Float(-1.0), mi.Float(2.0))
                lot = dr.select(met == 0, forced, lot)
            on, mirrored, share = bend(way, smooth, n_before, n_behind, lot, film)
            on_flat, mirrored_flat, share_flat = bend(way, flat, n_before, n_behind, lot, film)
            # Where a bent normal would send it to the wrong side, the flat one counts.
            right = (dr.dot(on, flat) > 0.0) == mirrored
            on, mirrored = dr.select(right, on, on_flat), dr.select(right, mirrored, mirrored_flat)
            if first is not None:
                part = share if first == 1 else 1.0 - share
                carried *= dr.select(goes_on & (met == 0), part, 1.0)
            if straight:
                carried *= dr.select(goes_on, 1.0 - share, 1.0)
                on, mirrored = way, mi.Bool(False)
            medium = dr.select(goes_on & ~mirrored, behind, medium)
            within = dr.select(goes_on & ~mirrored, after, within)
            met += dr.select(goes_on, 1, 0)
            aside = dr.select(mirrored, CLEAR, -CLEAR)
            origin = dr.select(goes_on, found.p + aside * flat, dr.select(length < FAR, at, origin))
            way = dr.select(goes_on, on, way)
            going = goes_on & (met < MOST)
        return carried, origin, way, normal, kind, met, wet, medium

    def sky(self, way):
        return dr.select(way.y > 0.0, colour(lights.CEILING), colour(lights.FLOOR))

    def plain(self, at, normal, albedo):
        """What a surface sends back with nothing before it: the shader's formula."""
        up = 0.5 + 0.5 * normal.y
        ambient = colour(lights.FLOOR) * (1.0 - up) + colour(lights.CEILING) * up
        to_window = vector(lights.WINDOW) - at
        square = dr.squared_norm(to_window)
        window = greater(dr.dot(normal, to_window), 0.0) * dr.rsqrt(square) / (1.0 + square)
        return albedo * ambient, albedo * colour(lights.WINDOW_POWER) * window

    def albedo(self, kind, normal):
        wall = dr.select(normal.y > 0.5, colour(lights.ALBEDO_FLOOR), colour(lights.ALBEDO_WALL))
        return dr.select(kind == 1, colour(lights.ALBEDO_TABLE), wall)

    def pane_place(self, u, v):
        """A place of the panes for two numbers from −1 to 1."""
        def beside(number, half):
            return dr.sign(number) * (self.bars + dr.abs(number) * (half - self.bars))
        across, along = vector(self.across), vector(self.along)
        return mi.Point3f(vector(self.window) + beside(u, self.half[0]) * across + beside(v, self.half[1]) * along)

    def weight(self, at, normal, place):
        """How much a place of the panes counts for the irradiance."""
        way = place - at
        square = dr.squared_norm(way)
        return greater(dr.dot(normal, way), 0.0) * greater(-dr.dot(way, vector(self.out)), 0.0) / (square * square)

    def density(self, at, way):
        """Of directions to places of the panes, all of which are as likely."""
        length = self.to_panes(at, way)
        area = 4.0 * (self.half[0] - self.bars) * (self.half[1] - self.bars)
        return dr.select(length < FAR, length * length / (area * greater(-dr.dot(way, vector(self.out)), 1e-6)), 0.0)

    def sent_back(self, at, normal, kind, rng):
        """What bench, floor or wall sends back."""
        albedo = self.albedo(kind, normal)
        ambient, window = self.plain(at, normal, albedo)
        if not self.options.shadows:
            return ambient + window
        start = at + normal * CLEAR
        # The panes.
        u, v = 2.0 * rng.next_float32() - 1.0, 2.0 * rng.next_float32() - 1.0
        place = self.pane_place(u, v)
        steps = [-0.75, -0.25, 0.25, 0.75]
        mean = sum(self.weight(at, normal, self.pane_place(mi.Float(a), mi.Float(b))) for a in steps for b in steps) / 16.0
        relative = self.weight(at, normal, place) / greater(mean, 1e-9)
        to_place = place - start
        if self.options.caustics:
            free = dr.select(self.bench.scene.ray_test(start_ray(start, to_place)), mi.Color3f(0.0), mi.Color3f(1.0))
        else:
            carried, *_, kind_end, _, _, _ = self.follow(start, dr.normalize(to_place), AIR, rng, False, None, True)
            free = dr.select(kind_end == 3, carried, 0.0)
        window *= 1.0 - relative * (1.0 - free)
        # The rest, half of the rays towards the panes: flat layers let those pass as if nothing were there.
        way = mi.Frame3f(normal).to_world(cosine_lot(rng.next_float32(), rng.next_float32()))
        u, v = 2.0 * rng.next_float32() - 1.0, 2.0 * rng.next_float32() - 1.0
        way = dr.select(rng.next_float32() < 0.5, way, dr.normalize(self.pane_place(u, v) - start))
        share = greater(dr.dot(way, normal), 0.0) / dr.pi
        relative = share / (0.5 * share + 0.5 * self.density(start, way))
        straight = not self.options.caustics
        carried, end, on, end_normal, end_kind, met, _, _ = self.follow(start, way, AIR, rng, False, None, straight)
        first, second = self.plain(end, end_normal, self.albedo(end_kind, end_normal))
        panes = dr.select((met > 0) & self.options.caustics, colour(self.pane_light) + self.sky(on), self.sky(on))
        seen = dr.select(end_kind == 1, first + second, dr.select(end_kind == 3, panes, self.sky(on)))
        seen = dr.select(met >= MOST, 0.0, seen)
        return ambient + window + albedo * dr.select(share > 0.0, relative * (carried * seen - self.sky(way)), 0.0)

    def seen(self, origin, way, rng, first, active=True):
        """The light that comes to an eye in air along `way`, of which `first` is told in `follow`; and whether glass or liquid
        is met at all, and liquid."""
        carried, end, on, normal, kind, met, wet, _ = self.follow(origin, way, AIR, rng, True, first, False)
        shaded = self.sent_back(end, normal, kind, rng)
        light = dr.select(kind == 3, colour(self.pane_light), shaded)
        light = dr.select((kind == 0) | (met >= MOST), 0.0, light)
        lost = met >= MOST
        if first == 1:
            light = dr.select(met > 0, light, 0.0)
        return carried * light, met > 0, wet, lost


def start_ray(start, to_place):
    """A ray that ends just before the place."""
    ray = mi.Ray3f(start, to_place)
    ray.maxt = 1.0 - 1e-4
    return ray
