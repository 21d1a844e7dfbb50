#!/bin/sh
# phreeqpython's `mass` of a solution is that of its water. Beside it, `volume` and `density` are those of the whole solution. So
# mass over volume makes sulfuric acid lighter the stronger it is.
set -eu
PHREEQPYTHON=${PHREEQPYTHON:-1.6.2}

there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
trap 'exit 2' INT TERM
python3 -m venv "$there/venv" || exit 2
"$there/venv/bin/pip" install -q --disable-pip-version-check "phreeqpython==$PHREEQPYTHON" numpy==2.4.6 \
    periodictable==2.1.0 || exit 2

cd "$there"
"$there/venv/bin/python" - <<'END_OF_PYTHON'
import sys
from importlib.metadata import version

from phreeqpython import PhreeqPython
from phreeqpython.solution import Solution

# g/mol
H2SO4 = 98.078
# mol in 1 kg of water
MOLALITIES = 0, 1, 5, 10

phreeqc = PhreeqPython(database="pitzer.dat")
# The unit of amounts is mmol.
solutions = [phreeqc.add_solution_simple({"H2SO4": 1000 * amount} if amount else {}, temperature=25) for amount in MOLALITIES]
half = solutions[-1] * 0.5
poured = half + solutions[0] * 0.5

print(f"phreeqpython {version('phreeqpython')}")
print("Solutions of sulfuric acid in 1 kg of water at 25 degC, by PHREEQC with its database for strong solutions:")
print("    mol   weighed in, kg   mass, kg   volume, L   density, kg/L   density x volume, kg   mass / volume, kg/L")
agree, water, ratios = [], [], []
for amount, solution in zip(MOLALITIES, solutions):
    weighed = 1 + amount * H2SO4 / 1000
    whole = solution.density * solution.volume
    ratios.append(solution.mass / solution.volume)
    print(f"    {amount:3} {weighed:16.3f} {solution.mass:10.3f} {solution.volume:11.3f} {solution.density:15.3f}"
          f" {whole:22.3f} {ratios[-1]:21.3f}")
    agree.append(abs(whole - weighed) < 0.001 * weighed)
    water.append(abs(solution.mass - 1) < 0.001)
print("Expected: mass is what was weighed in, which is density times volume, or its documentation says that it is the water's.")
print(f"Seen: mass is 1 kg with any amount of acid. Its documentation is {Solution.mass.__doc__!r}.")
print(f"Half of the last solution and 0.5 kg of water are mixed: {0.5 * (1 + 10 * H2SO4 / 1000) + 0.5:.3f} kg, of which mass is"
      f" {poured.mass:.3f} kg.")

falling = all(a > b for a, b in zip(ratios, ratios[1:])) and abs(ratios[-1] - 0.702) < 0.005
strongest = abs(solutions[-1].density - 1.391) < 0.005
if not (all(agree) and all(water) and abs(poured.mass - 1) < 0.001 and falling and strongest and not Solution.mass.__doc__):
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
