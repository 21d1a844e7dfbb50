"""Truth and ours by FLIP, side by side, and as rows of a table."""

import flip_evaluator
import numpy as np
from PIL import Image


def flip(reference, test, pixels_per_degree):
    """FLIP's map of two encoded pictures, 0 to 1."""
    pictures = [np.ascontiguousarray(picture, np.float32) for picture in (reference, test)]
    parameters = {"ppd": float(pixels_per_degree)}
    errors, _, _ = flip_evaluator.evaluate(*pictures, "LDR", True, False, True, parameters)
    return np.asarray(errors).reshape(reference.shape[0], reference.shape[1], -1)[..., 0]


def opened(file, side):
    """The middle of a PNG file, encoded, 0 to 1."""
    picture = np.asarray(Image.open(file).convert("RGB"), np.float32) / 255.0
    top, left = ((size - side) // 2 for size in picture.shape[:2])
    return picture[top : top + side, left : left + side]


def colours(errors):
    """Errors as colours: black for none, over violet and orange to light yellow for 1; brightness grows evenly."""
    stops = np.array([[0, 0, 4], [87, 16, 110], [188, 55, 84], [249, 142, 9], [252, 255, 164]]) / 255.0
    places = np.linspace(0.0, 1.0, len(stops))
    return np.stack([np.interp(errors, places, stops[:, n]) for n in range(3)], -1)


def saved(file, pictures):
    """Encoded pictures beside each other in a PNG file."""
    row = np.concatenate([np.clip(picture, 0.0, 1.0) for picture in pictures], 1)
    Image.fromarray((255.0 * row + 0.5).astype(np.uint8)).save(file, optimize=True)


def means(errors, masks):
    """Means over the pixels of each mask, by name; None for an empty one."""
    return {name: float(errors[mask].mean()) if mask.any() else None for name, mask in masks.items()}


def table(rows):
    """Rows of Markdown."""
    heads = list(rows[0])
    text = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    for row in rows:
        cells = (f"{value:.3f}" if isinstance(value, float) else "–" if value is None else str(value) for value in row.values())
        text.append("| " + " | ".join(cells) + " |")
    return "\n".join(text) + "\n"
