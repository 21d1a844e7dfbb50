"""Small sums that paths are made of."""

import drjit as dr
import mitsuba as mi


def greater(a, b):
    """The greater of two. `dr.maximum` is an instruction that LLVM before 17 has not got on x86."""
    return dr.select(a > b, a, b)


def lesser(a, b):
    """The lesser of two, likewise."""
    return dr.select(a < b, a, b)


def vector(values):
    return mi.Vector3f(*[float(value) for value in values])


def colour(values):
    return mi.Color3f(*[float(value) for value in values])


def bend(way, normal, before, after, lot, film=False):
    """Where a ray goes on at a surface whose normal faces it; the lot says whether it is mirrored. With that, the reflectance.

    A film mirrors at two faces, with all that goes to and fro between them, and what it lets pass goes straight on."""
    cosine = greater(-dr.dot(way, normal), 1e-6)
    ratio = before / after
    sine = ratio * ratio * greater(1.0 - cosine * cosine, 0.0)
    inner = dr.sqrt(greater(1.0 - sine, 0.0))
    s = (before * cosine - after * inner) / (before * cosine + after * inner)
    p = (before * inner - after * cosine) / (before * inner + after * cosine)
    share = dr.select(sine >= 1.0, 1.0, 0.5 * (s * s + p * p))
    share = dr.select(film, 2.0 * share / (1.0 + share), share)
    mirrored = lot < share
    back = way + 2.0 * cosine * normal
    on = ratio * way + (ratio * cosine - inner) * normal
    on = dr.select(film, way, on)
    return dr.normalize(dr.select(mirrored, back, on)), mirrored, share


def cosine_lot(u, v):
    """A direction about +Z, as likely as its cosine."""
    sin, cos = dr.sincos(2.0 * dr.pi * u)
    radius = dr.sqrt(v)
    return mi.Vector3f(radius * cos, radius * sin, dr.sqrt(1.0 - v))
