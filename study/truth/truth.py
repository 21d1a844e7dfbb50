"""What Vitriol draws against the same scene by traced paths.

    pip install -r study/truth/requirements.txt
    python3 study/truth/truth.py --vitriol target/release/vitriol --out DIR [--still NAME] [--samples N]

For each still: exports surfaces and particles, takes our picture from the same place, traces the truth twice with
other random numbers, and compares by FLIP over the pixels that show glass or liquid. Files of a still are in DIR/NAME:
`truth.png`, `ours.png`, and `side.png` with truth, ours and FLIP. `DIR/truth.md` and `truth.json` have the figures.

A run needs LLVM's shared library beside Mitsuba, as the software Vulkan driver does. What was exported or taken before into
DIR is taken as it is; `--again` takes it anew.
"""

import argparse
import json
import math
import subprocess
import sys
from pathlib import Path

# A headset's eye of 2064 × 2208 pixels that sees 54° outwards and 40° inwards (0.94 and 0.70 rad): pixels over the tangent.
FOCAL = 2064 / (math.tan(0.94) + math.tan(0.70))
PIXELS_PER_DEGREE = FOCAL * math.pi / 180.0
# Sides of the crop and of the picture that it is the middle of, pixels: the picture's corner has a legend.
CROP, PICTURE = 512, 768

# Track and scene, time in s, eye and target in m.
STILLS = {
    "rest": (["two-flasks"], 0.5, (-0.09, 0.96, -0.12), (-0.12, 0.80, -0.40)),
    "pour": (["two-flasks"], 4.2, (0.04, 1.015, -0.04), (0.09, 0.845, -0.40)),
    "boil": (["two-flasks", "--scene", "water-into-acid"], 5.2, (0.07, 1.0, -0.07), (0.10, 0.84, -0.40)),
    "soup": (["hands-off", "--scene", "tomato-soup"], 2.0, (0.03, 0.248, 0.26), (0.0, 0.075, 0.0)),
}

# What is left out of the truth to see what it costs.
VARIANTS = {
    "no caustics": {"caustics": False},
    "no shadows": {"shadows": False},
    "no mirrors": {"mirrors": False},
    "one index": {"index_of_acid": 0.0},
}


def taken(args, name):
    """The folder with what was exported, and our picture's file; takes them where they are not there yet."""
    (what, at, eye, target), folder = STILLS[name], args.out / name
    folder.mkdir(parents=True, exist_ok=True)
    exported, picture = folder / "export", folder / "picture.png"
    common = [*what, "--preset", "fast", "--at", str(at)]
    device = ["--device", args.device] if args.device else []
    if args.again:
        picture.unlink(missing_ok=True)
    if args.again or not (exported / "table.ply").exists():
        # What was exported is as the picture is: the middle of the same run.
        for old in exported.glob("*"):
            old.unlink()
        run([args.vitriol, "export", *common, "--format", "ply,vtk", "--out", str(exported), *device])
    if not picture.exists():
        place = [",".join(str(part) for part in point) for point in (eye, target)]
        field = math.degrees(2.0 * math.atan(0.5 * PICTURE / FOCAL))
        size = f"{PICTURE}x{PICTURE}"
        seen = [f"--eye={place[0]}", f"--target={place[1]}", "--field", str(field), "--size", size]
        # Furniture and print are not exported.
        run([args.vitriol, "picture", *common, *seen, "--room", "bare", "-o", str(picture), *device])
    return exported, picture


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stderr[-2000:]}")


def judged(args, name):
    """The still's row: means of FLIP by what is compared and where."""
    import numpy as np

    import compare
    from bench import Camera, load
    from light import display, encoded
    from paths import Options, Paths
    from render import render

    exported, picture = taken(args, name)
    folder, (_, _, eye, target) = args.out / name, STILLS[name]
    camera = Camera(np.array(eye), np.array(target), FOCAL, CROP)
    bench = load(exported)

    def shown(seed, **options):
        still = render(Paths(bench, Options(**options)), camera, args.samples, seed)
        return still, encoded(display(still.light))

    still, truth = shown(1)
    other = shown(2)[1]
    both = 0.5 * (truth + other)
    ours = compare.opened(picture, CROP)
    masks = {"all": still.covered > 0.5, "liquid": still.wet > 0.5}
    masks["glass"] = masks["all"] & ~masks["liquid"]
    flip = lambda a, b: compare.flip(a, b, PIXELS_PER_DEGREE)
    errors = flip(both, ours)
    row = {"still": name, "pixels": int(masks["all"].sum()), **compare.means(errors, masks)}
    row["truth, other seed"] = float(flip(truth, other)[masks["all"]].mean())
    row["background"] = float(errors[~masks["all"]].mean())
    row["rays given up"] = still.lost
    for variant in args.variants:
        changed = shown(1, **VARIANTS[variant])[1]
        row[f"ours to truth with {variant}"] = float(flip(changed, ours)[masks["all"]].mean())
        row[f"truth to truth with {variant}"] = float(flip(both, changed)[masks["all"]].mean())
        compare.saved(folder / f"{variant.replace(' ', '-')}.png", [changed])
    compare.saved(folder / "truth.png", [both])
    compare.saved(folder / "ours.png", [ours])
    compare.saved(folder / "side.png", [both, ours, compare.colours(errors)])
    np.savez_compressed(folder / "figures.npz", errors=errors, light=still.light, covered=still.covered, wet=still.wet)
    return row


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vitriol", default="target/release/vitriol", help="the program")
    parser.add_argument("--out", type=Path, required=True, help="folder for all files")
    parser.add_argument("--still", choices=STILLS, action="append", help="one of them; without it all")
    parser.add_argument("--samples", type=int, default=512, help="rays a pixel where glass or liquid is near")
    parser.add_argument("--without", dest="variants", choices=VARIANTS, action="append", default=[], help="also trace without this")
    parser.add_argument("--again", action="store_true", help="simulate again, though the files are there")
    parser.add_argument("--device", help="device of vitriol")
    parser.add_argument("--threads", type=int, help="processor threads of the truth; without it all")
    return parser.parse_args()


def main():
    args = arguments()
    import drjit
    import mitsuba

    mitsuba.set_variant("llvm_ad_rgb")
    if args.threads:
        drjit.set_thread_count(args.threads)
    import compare

    rows = []
    for name in args.still or STILLS:
        rows.append(judged(args, name))
        print(compare.table(rows[-1:]), flush=True)
        (args.out / "truth.json").write_text(json.dumps(rows, indent=2))
    # Columns that only some stills have are left out of none.
    heads = list(dict.fromkeys(head for row in rows for head in row))
    (args.out / "truth.md").write_text(compare.table([{head: row.get(head) for head in heads} for row in rows]))


if __name__ == "__main__":
    main()
