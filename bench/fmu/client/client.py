"""FMPy on units of every scene, for FMI 2.0 and 3.0: description, outputs bit for bit, states, refusals."""

import argparse
import csv
import importlib.metadata
import os
import subprocess
import time

from fmpy.validation import validate_fmu

import bits
import refusals
import states
from both import Unit

# Scene, design, arguments of `simulate`, manoeuvre.
CASES = [
    ("caged", "lin-4.1", [], "weave"),
    ("caged-with-memory", "lin-4.1", ["--memory"], "weave"),
    ("mechanism", "lin-4.1", ["--mechanism", "--inertia", "4e-4"], None),
    ("mechanism", "told.toml", ["--mechanism"], None),
    ("uncaged", "lin-3.6", ["--scene", "uncaged"], "turns"),
    ("uncaged-with-memory", "lin-3.6", ["--scene", "uncaged", "--memory"], "turns"),
    ("linear", "lin-3.3", ["--scene", "linear"], "stroke"),
    ("linear-with-memory", "lin-3.3", ["--scene", "linear", "--memory"], "stroke"),
    ("uncaged", "sixteen.toml", ["--scene", "uncaged"], "turns"),
]

# Most rows of a table that are compared.
ROWS = 2500

# A design file with another number of balls.
SIXTEEN = """
pitch_radius = 10.0e-3
lead = 10e-3
ball_diameter = 3.969e-3
conformity = 0.54
contact_angle = 0.7853982
friction = 0.08
loaded_balls = 16
[limits]
nut_speed = 500.0
[uncaged]
balls = 16
turns = 1.1
screw_deviation = [{ order = 2, sine = 0.02 }]
"""

# A design file with what a trace has told of a screw.
TOLD = """
pitch_radius = 14.5e-3
lead = 7e-3
ball_diameter = 4e-3
conformity = 0.54
contact_angle = 0.7853982
friction = 0.09
preload = 20.0
loaded_balls = 71
[calibration]
full_film_ratio = 0.7
half_share_speed = 20.0
direction_asymmetry = 0.03
breakaway_angle = 0.02
reference_load = 800.0
backlash = 1e-3
inertia = 5e-4
drag = 1e-3
offset = 0.01
gain = 0.98
"""


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = path, folder

    def run(self, *arguments):
        done = subprocess.run(
            [self.path, *arguments], cwd=self.folder, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, (arguments, done.stderr)

    def unit(self, scene, design, version):
        name = f"{scene}-{design}-{version}.fmu"
        self.run("fmu", "--scene", scene, "--design", design, "--fmi", str(version), "--output", name)
        return Unit(os.path.join(self.folder, name))

    def table(self, scene, design, arguments, manoeuvre):
        """The table of `simulate` over a trace whose times are multiples of one step, as FMPy's are."""
        name = f"{scene}-{design}"
        trace = os.path.join(self.folder, f"{name}-trace.csv")
        if manoeuvre is None:
            write(trace, pushes())
        else:
            first = f"{name}-manoeuvre.csv"
            self.run("simulate", "--design", design, *arguments, "--manoeuvre", manoeuvre, "--output", first)
            write(trace, regular(bits.read(os.path.join(self.folder, first))))
        self.run("simulate", "--design", design, *arguments, "--input", trace, "--output", f"{name}.csv")
        return bits.read(os.path.join(self.folder, f"{name}.csv"))


def regular(rows):
    step = float(rows[1]["time"]) - float(rows[0]["time"])
    step = float(f"{step:.9g}")
    return [{**row, "time": repr(index * step)} for index, row in enumerate(rows[:ROWS])]


def pushes():
    """A motor torque that moves a nut to and fro, under a load that changes."""
    rows = []
    for index in range(800):
        torque = 1.2 if (index // 200) % 2 == 0 else -1.1
        rows.append({"time": repr(index * 1e-3), "motor_torque": repr(torque * (index % 200) / 200),
                     "axial_load": repr(300.0 + 0.5 * index)})
    return rows


def write(path, rows):
    keep = [name for name in rows[0]
            if name in ("time", "nut_speed", "axial_load", "motor_torque", "speed", "normal_load", "side_load")]
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, keep, extrasaction="ignore")
        table.writeheader()
        table.writerows(rows)


def start_of(unit, rows):
    """Parameters that `simulate` takes from its trace; how many ticks it makes of a sample."""
    start = {}
    load = "normal_load" if "normal_load" in rows[0] else "axial_load"
    if "mean_load" in unit.variables:
        total = 0.0
        for row in rows:
            total += abs(float(row[load]))
        start["mean_load"] = total / len(rows)
    ticks, tick = 1, float(rows[1]["time"]) - float(rows[0]["time"])
    if "motor_torque" in rows[0]:
        tick = (float(rows[-1]["time"]) - float(rows[0]["time"])) / (len(rows) - 1)
        start["tick"] = tick
    elif "tick" in unit.variables:
        longest = float(unit.variables["tick"].start)
        while tick / ticks > longest * (1 + 1e-9):
            ticks *= 2
        start["tick"] = tick / ticks
        tick = start["tick"]
    return start, ticks, tick


def check(program, scene, design, arguments, manoeuvre, version):
    unit = program.unit(scene, design, version)
    problems = validate_fmu(unit.path)
    assert not problems, problems
    rows = program.table(scene, design, arguments, manoeuvre)
    start, ticks, tick = start_of(unit, rows)
    compared, columns = bits.lockstep(unit, rows, start, ticks, tick)
    looped = bits.simulated(unit, rows, start) if ticks == 1 else 0
    size = states.rewind(unit, rows[:200], start, tick)
    refused = refusals.Refusals(unit, start, tick).all()
    print(
        f"FMI {version} {scene:20} {design:13} {len(rows)} rows, {len(columns)} columns, {ticks} ticks: "
        f"{compared} outputs bit for bit in steps, {looped} in simulate_fmu; state {size} bytes; {refused} refusals"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, help="path of epas")
    parser.add_argument("--folder", required=True, help="an empty folder to work in")
    parser.add_argument("--scene", help="this scene alone")
    arguments = parser.parse_args()
    arguments.folder = os.path.abspath(arguments.folder)
    program = Program(os.path.abspath(arguments.program), arguments.folder)
    for name, text in (("sixteen.toml", SIXTEEN), ("told.toml", TOLD)):
        with open(os.path.join(arguments.folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    began = time.monotonic()
    print("FMPy", importlib.metadata.version("fmpy"))
    for scene, design, options, manoeuvre in CASES:
        if arguments.scene in (None, scene):
            for version in (2, 3):
                check_table = [path for path in os.listdir(arguments.folder) if path.startswith(f"{scene}-{design}") and path.endswith(".csv")]
                for path in check_table:
                    os.remove(os.path.join(arguments.folder, path))
                check(program, scene, design, options, manoeuvre, version)
    print(f"all in {time.monotonic() - began:.0f} s")


if __name__ == "__main__":
    main()
