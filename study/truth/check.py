"""Tests of the truth itself against formulas: `python3 -m unittest check` in this folder, or `python3 study/truth/check.py`."""

import math
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import drjit as dr
import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")

import balls
import compare
import light as lights
from bench import Bench, Camera, cube, finish
from light import AIR, LIQUID
from paths import MOST, Options, Paths
from render import random_numbers, rays, render
from tools import cosine_lot, vector

SHADERS = Path(__file__).parents[2] / "shaders/wgsl/common/picture"
ROOM = (np.array([-1.6, 0.0, -1.7]), np.array([2.4, 2.7, 2.4]))
TABLE = (np.array([-0.6, 0.71, -0.8]), np.array([0.6, 0.75, -0.1]))


def bench_of(**shapes):
    bench = Bench(room=ROOM, table=TABLE)
    finish(bench, {"type": "scene", **shapes, "table": cube(*TABLE)})
    return bench


def sheet(height, down=False):
    """A horizontal square about the bench's middle; its normal points up."""
    turned = mi.ScalarTransform4f().translate([0, height, -0.4]).rotate([1, 0, 0], 90 if down else -90).scale(0.25)
    return {"type": "rectangle", "to_world": turned}


def ball(radius, inward=False):
    return {"type": "sphere", "center": [0, 1.2, -0.4], "radius": radius, "flip_normals": inward}


def fired(paths, origin, way, medium, count=1, **options):
    rng = random_numbers(count, 5)
    spread = dr.zeros(mi.Vector3f, count)
    arguments = {"room": True, "first": None, "straight": False, **options}
    return paths.follow(vector(origin) + spread, dr.normalize(vector(way)) + spread, mi.UInt(medium) + dr.zeros(mi.UInt, count), rng, **arguments)


class Formulas(unittest.TestCase):
    def test_constants_are_the_shaders(self):
        text = "".join((SHADERS / name).read_text() for name in ("daylight.wgsl", "room.wgsl", "laboratory.wgsl", "worktop.wgsl", "liquid_light.wgsl", "schlieren.wgsl", "through_wall.wgsl"))
        triple = r"vec3<f32>\(([^()]*)\)"
        named = {"WINDOW": lights.WINDOW, "WINDOW_POWER": lights.WINDOW_POWER, "CEILING_LIGHT": lights.CEILING, "FLOOR_LIGHT": lights.FLOOR}
        for name, ours in named.items():
            theirs = re.search(rf"const {name}: vec3<f32> = {triple};", text).group(1)
            self.assertEqual([float(part) for part in theirs.split(",")], ours.tolist(), name)
        triples = [[float(part) for part in found.split(",")] for found in re.findall(triple, text) if re.fullmatch(r"[\d., ]+", found)]
        for albedo in (lights.ALBEDO_WALL, lights.ALBEDO_FLOOR, lights.ALBEDO_TABLE):
            self.assertIn(albedo.tolist(), triples)
        number = lambda name: float(re.search(rf"const {name}(?:: f32)? = ([\d.]+)", text).group(1))
        self.assertEqual(number("INDEX"), lights.INDEX_WATER)
        self.assertEqual(number("GLASS_INDEX"), lights.INDEX_GLASS)
        self.assertAlmostEqual(number("INDEX_OF_ACID"), Options().index_of_acid, 4)

    def test_the_window_is_the_shaders(self):
        text = (SHADERS / "daylight.wgsl").read_text()
        parts = lambda name: [float(part) for part in re.search(rf"const {name}: \w+<f32> = \w+<f32>\(([^()]*)\);", text).group(1).split(",")]
        half, bars, radiance = lights.panes()
        across, along, out = lights.window_axes()
        # Rounded to what is seen: a centimetre of two metres.
        named = {"WINDOW_HALF": half, "PANE_LIGHT": radiance, "WINDOW_ACROSS": across, "WINDOW_UP": along, "WINDOW_OUT": out}
        for name, ours in named.items():
            np.testing.assert_allclose(parts(name), ours, atol=0.01, err_msg=name)
        self.assertAlmostEqual(float(re.search(r"const WINDOW_BAR: f32 = ([\d.]+);", text).group(1)), bars, 2)

    def test_display_and_encoding(self):
        # By hand: 0.18 gives 0.18·0.4818/(0.18·1.0274 + 0.14) = 0.26688; sRGB of 0.5 is 0.73536.
        self.assertAlmostEqual(lights.display(np.array(0.18)).item(), 0.26688, 4)
        self.assertAlmostEqual(lights.encoded(np.array(0.5)).item(), 0.73536, 4)

    def test_water_surface_mirrors_by_fresnel(self):
        paths = Paths(bench_of(air_liquid=sheet(0.80)), Options(tint=False))
        for degrees in (0.0, 45.0, 75.0, 85.0):
            angle = math.radians(degrees)
            inner = math.asin(math.sin(angle) / 1.333)
            if degrees:
                s = math.sin(angle - inner) / math.sin(angle + inner)
                p = math.tan(angle - inner) / math.tan(angle + inner)
                expected = 0.5 * (s * s + p * p)
            else:
                expected = (0.333 / 2.333) ** 2
            way = [math.sin(angle), -math.cos(angle), 0.0]
            origin = np.array([0.0, 0.80, -0.4]) - 0.01 * np.array(way)
            carried = fired(paths, origin, way, AIR, first=1)[0]
            self.assertAlmostEqual(carried.x[0], expected, 4)
            # The lot's share of mirrored rays is the same.
            count = 200_000
            kind = np.array(fired(paths, origin, way, AIR, count)[4])
            self.assertAlmostEqual(np.mean(kind != 1), expected, delta=4 * math.sqrt(expected / count))

    def test_water_bends_by_snell_and_dims_by_beer(self):
        depth = 0.04
        paths = Paths(bench_of(air_liquid=sheet(0.75 + depth)), Options())
        for degrees in (0.0, 30.0, 60.0):
            angle = math.radians(degrees)
            inner = math.asin(math.sin(angle) / 1.333)
            way = np.array([math.sin(angle), -math.cos(angle), 0.0])
            origin = np.array([0.0, 0.75 + depth, -0.4]) - 0.02 * way
            carried, end, _, _, kind, met, wet, _ = fired(paths, origin, way, AIR, first=0)
            self.assertEqual((kind[0], met[0], wet[0]), (1, 1, True))
            self.assertAlmostEqual(end.x[0], depth * math.tan(inner), 5)
            cosines = math.cos(angle), math.cos(inner)
            s = (cosines[0] - 1.333 * cosines[1]) / (cosines[0] + 1.333 * cosines[1])
            p = (cosines[1] - 1.333 * cosines[0]) / (cosines[1] + 1.333 * cosines[0])
            passed = 1.0 - 0.5 * (s * s + p * p)
            for got, share in zip(carried, (0.40, 0.74, 0.92)):
                self.assertAlmostEqual(got[0], passed * share ** (depth / math.cos(inner) / 0.06), 4)

    def test_under_water_all_is_mirrored_beyond_the_critical_angle(self):
        paths = Paths(bench_of(air_liquid=sheet(0.80)), Options(tint=False))
        critical = math.degrees(math.asin(1.0 / 1.333))
        for degrees, mirrored in ((critical - 1.0, False), (critical + 1.0, True)):
            angle = math.radians(degrees)
            way = [math.sin(angle), math.cos(angle), 0.0]
            kind = np.array(fired(paths, [0.0, 0.79, -0.4], way, LIQUID, 20_000)[4])
            self.assertEqual(bool(np.all(kind == 1)), mirrored)

    def test_plate_of_glass_moves_a_ray_aside(self):
        thick, angle = 0.01, math.radians(50.0)
        plate = {"type": "cube", "to_world": mi.ScalarTransform4f().translate([0, 0.85, -0.4]).scale([0.2, 0.5 * thick, 0.2])}
        paths = Paths(bench_of(air_glass=plate), Options())
        inner = math.asin(math.sin(angle) / 1.47)
        way = np.array([math.sin(angle), -math.cos(angle), 0.0])
        origin = np.array([-0.05, 0.90, -0.4])
        _, end, on, _, kind, met, _, _ = fired(paths, origin, way, AIR, 64)
        straight = (np.array(kind) == 1) & (np.array(met) == 2)
        self.assertTrue(straight.any())
        expected = -0.05 + (0.15 - thick) * math.tan(angle) + thick * math.tan(inner)
        np.testing.assert_allclose(np.array(end.x)[straight], expected, atol=1e-5)
        np.testing.assert_allclose(np.array(on.x)[straight], math.sin(angle), atol=1e-5)

    def test_clear_glass_in_an_even_sky_is_not_seen(self):
        """A ball of water in a shell of glass sends on what it gets: 1 everywhere, at the rim as in the middle."""
        shapes = {"air_glass": ball(0.05), "glass_liquid": ball(0.045, True)}
        paths = Paths(bench_of(**shapes), Options(tint=False))
        eye, target = np.array([0.0, 1.2, 0.0]), np.array([0.0, 1.2, -0.4])
        camera = Camera(eye, target, 200.0, 64)
        rng = random_numbers(64 * 64 * 16, 3)
        origin, way = rays(camera, np.arange(64 * 64, dtype=np.uint32), 16, rng)
        total = 0.0
        for first in (0, 1):
            carried, _, _, _, kind, met, _, _ = paths.follow(origin, way, mi.UInt(AIR), rng, True, first, False)
            self.assertLess(np.mean(np.array(met) == MOST), 1e-3)
            share = np.array(carried.x)
            total = total + (share if first == 0 else np.where(np.array(met) > 0, share, 0.0))
        np.testing.assert_allclose(total, 1.0, atol=1e-5)

    def test_a_bubble_bends_by_snell_and_mirrors_all_beyond_the_critical_angle(self):
        radius, index, centre = 0.01, 1.333, np.array([0.0, 1.2, -0.4])
        # A smaller ball in it is no more of a bubble.
        both = np.array([centre, centre])
        for shapes in ([centre[None], [radius]], [both, [radius, 0.6 * radius]]):
            paths = Paths(bench_of(air_bubble=balls.balls("air_bubble", *shapes)), Options(tint=False))
            count, faces = 40_000, 2 * len(shapes[1])
            for share in (0.2, 0.4, 0.6, 0.85):
                inner = share < 1.0 / index
                outside = math.asin(share)
                turn = 2.0 * (math.asin(share * index) - outside) if inner else math.pi - 2.0 * outside
                # Aside by b, upwards: what goes into thinner matter goes away from the normal, so up.
                origin = centre + [-0.05, share * radius, 0.0]
                _, _, on, _, _, met, _, _ = fired(paths, origin, [1, 0, 0], LIQUID, count)
                on, met = np.array(on), np.array(met)
                crossed = faces if share < 0.6 else 2
                through = met == (crossed if inner else 1)
                angle = np.arctan2(on[1], on[0])[through]
                np.testing.assert_allclose(angle, turn, atol=0.02 if inner else 0.01, err_msg=str(share))
                if inner:
                    gas = math.asin(share * index)
                    s = math.sin(gas - outside) / math.sin(gas + outside)
                    p = math.tan(gas - outside) / math.tan(gas + outside)
                    passed = (1.0 - 0.5 * (s * s + p * p)) ** 2
                    self.assertAlmostEqual(np.mean(through), passed, delta=5 * math.sqrt(passed * (1 - passed) / count) + 2e-3)
                else:
                    self.assertTrue(through.all())

    def test_a_bubble_in_the_air_is_a_film(self):
        radius, centre = 0.01, np.array([0.0, 1.2, -0.4])
        paths = Paths(bench_of(air_bubble=balls.balls("air_bubble", centre[None], [radius])), Options(tint=False))
        for share in (0.1, 0.5, 0.9):
            outside, inner = math.asin(share), math.asin(share / 1.333)
            s = math.sin(outside - inner) / math.sin(outside + inner)
            p = math.tan(outside - inner) / math.tan(outside + inner)
            face = 0.5 * (s * s + p * p)
            passed = (1.0 - face) / (1.0 + face)
            origin = centre + [-0.05, share * radius, 0.0]
            carried, end, on, _, _, met, _, _ = fired(paths, origin, [1, 0, 0], AIR, 64, first=0)
            self.assertAlmostEqual(carried.x[0], passed, delta=0.01 * passed)
            straight = np.array(met) == 2
            self.assertTrue(straight.any())
            np.testing.assert_allclose(np.array(end.y)[straight], origin[1], atol=1e-5)
            carried, _, on, *_ = fired(paths, origin, [1, 0, 0], AIR, first=1)
            self.assertAlmostEqual(carried.x[0], 1.0 - passed, delta=0.01 * passed)
            self.assertAlmostEqual(math.atan2(on.y[0], on.x[0]), math.pi - 2.0 * outside, 2)

    def test_the_surface_ends_at_a_bubble(self):
        """A bubble half out of water: a film, no surface within, and the wall below."""
        radius, centre, share = 0.01, np.array([0.0, 0.80, -0.4]), 0.5
        shapes = {"air_liquid": sheet(0.80), "air_bubble": balls.balls("air_bubble", centre[None], [radius])}
        paths = Paths(bench_of(**shapes), Options(tint=False))
        origin = centre + [share * radius, 0.02, 0.0]
        _, _, on, _, kind, met, wet, _ = fired(paths, origin, [0, -1, 0], AIR, 4096)
        straight = (np.array(met) == 3) & (np.array(kind) == 1)
        self.assertTrue(np.mean(straight) > 0.8)
        outside, inner = math.asin(share), math.asin(share / 1.333)
        # Into thicker matter below the middle: away from the axis by the angle between them.
        np.testing.assert_allclose(np.arctan2(np.array(on)[0], -np.array(on)[1])[straight], outside - inner, atol=0.01)

    def test_panes_light_the_bench_as_the_key_light_does(self):
        half, bars, radiance = lights.panes()
        direction, key = lights.key_light(lights.BENCH)
        np.testing.assert_allclose(lights.facing(lights.BENCH, lights.UP, half, bars) * radiance, math.pi * key * direction[1], rtol=1e-3)
        # Two hands beside it the two laws differ by 6 % at most.
        for aside in ([0.2, 0, 0], [-0.2, 0, 0], [0, 0, 0.2], [0, 0.1, 0]):
            at = lights.BENCH + aside
            direction, key = lights.key_light(at)
            np.testing.assert_allclose(lights.facing(at, lights.UP, half, bars) * radiance, math.pi * key * direction[1], rtol=0.06)
        # By paths: rays by the cosine about the vertical that find the panes.
        paths = Paths(bench_of(), Options())
        count = 400_000
        rng = random_numbers(count, 9)
        direction, key = lights.key_light(lights.BENCH)
        way = mi.Frame3f(vector(lights.UP)).to_world(cosine_lot(rng.next_float32(), rng.next_float32()))
        start = vector(lights.BENCH) + dr.zeros(mi.Vector3f, count)
        kind = np.array(paths.follow(start, way, mi.UInt(AIR), rng, False, None, False)[4])
        share = np.mean(kind == 3)
        self.assertAlmostEqual(share * radiance[1], key[1] * direction[1], delta=5 * radiance[1] * math.sqrt(share / count))

    def test_bench_and_walls_send_back_what_the_shader_says(self):
        paths = Paths(bench_of(), Options())
        camera = Camera(np.array([0.0, 1.1, 0.1]), np.array([0.0, 0.8, -0.4]), 60.0, 64)
        still = render(paths, camera, 8, 1)
        self.assertFalse(still.covered.any())
        rng = random_numbers(1, 1)
        # Wall and floor see the bench, which is brighter than the hemisphere behind it, or darker; the shader's do not.
        for at, normal, kind, albedo, within in (
            ([0.1, 0.75, -0.3], [0, 1, 0], 1, lights.ALBEDO_TABLE, 1e-3),
            ([0.4, 1.3, -1.7], [0, 0, 1], 2, lights.ALBEDO_WALL, 0.02),
            ([0.1, 0.0, 1.3], [0, 1, 0], 2, lights.ALBEDO_FLOOR, 0.02),
        ):
            direction, key = lights.key_light(np.array(at))
            expected = albedo * (lights.ambient_light(np.float64(normal[1])) + max(direction @ normal, 0.0) * key)
            many = dr.zeros(mi.Vector3f, 20_000)
            rng = random_numbers(20_000, 2)
            got = paths.sent_back(mi.Point3f(vector(at) + many), mi.Normal3f(vector(normal) + many), mi.UInt(kind), rng)
            np.testing.assert_allclose(np.array(got).mean(1), expected, rtol=within)

    def test_light_through_a_plate_is_what_passes_two_surfaces(self):
        """Under a wide clear plate the sky's light is 1 − 2R̄/(1 + R̄) or so: here by quadrature over the angle."""
        plate = {"type": "cube", "to_world": mi.ScalarTransform4f().translate([0, 0.76, -0.4]).scale([0.6, 0.001, 0.4])}
        count = 400_000
        paths = Paths(bench_of(air_glass=plate), Options())
        way = mi.Frame3f(mi.Normal3f(0, 1, 0)).to_world
        rng = random_numbers(count, 4)
        start = vector([0.0, 0.7501, -0.4]) + dr.zeros(mi.Vector3f, count)
        kind = np.array(paths.follow(start, way(cosine_lot(rng.next_float32(), rng.next_float32())), mi.UInt(AIR), rng, False, None, False)[4])
        angles = (np.arange(2000) + 0.5) * 0.5 * math.pi / 2000
        inner = np.arcsin(np.sin(angles) / 1.47)
        s = np.sin(angles - inner) ** 2 / np.sin(angles + inner) ** 2
        p = np.tan(angles - inner) ** 2 / np.tan(angles + inner) ** 2
        # All that a plate mirrors, of either polarisation mixed as the paths mix it.
        r = 0.5 * (s + p)
        passed = np.sum((1 - r) / (1 + r) * np.sin(2 * angles)) * 0.5 * math.pi / 2000
        self.assertAlmostEqual(np.mean(kind != 1), passed, delta=5 * math.sqrt(0.25 / count))

    def test_balls_have_their_volume_and_drops_their_places(self):
        mesh = balls.balls("spray", np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), [0.1, 0.2])
        parameters = mi.traverse(mesh)
        places = np.array(parameters["vertex_positions"]).reshape(-1, 3)
        a, b, c = (places[np.array(parameters["faces"]).reshape(-1, 3)[:, n]] for n in range(3))
        self.assertAlmostEqual(np.sum(np.cross(a, b) * c) / 6.0, 4.0 / 3.0 * math.pi * (0.1**3 + 0.2**3), 6)
        text = (SHADERS / "spray_drops.wgsl").read_text()
        number = lambda name: float(re.search(rf"const {name} = ([\d.]+)", text).group(1))
        self.assertEqual(number("JET_STEP"), balls.JET_STEP)
        self.assertEqual(number("MOST_DROPS"), balls.MOST_DROPS)

    def test_flip_of_a_picture_with_itself_is_0(self):
        picture = np.random.default_rng(1).random((64, 64, 3), np.float32)
        self.assertLess(compare.flip(picture, picture, 16.0).max(), 1e-6)
        self.assertGreater(compare.flip(picture, 1.0 - picture, 16.0).mean(), 0.2)


if __name__ == "__main__":
    unittest.main()
