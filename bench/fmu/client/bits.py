"""Outputs of a unit against those of `simulate`, bit for bit."""

import csv
import struct

import fmpy
import numpy as np

from both import Instance

REGIMES = {"standing": 0, "driving": 1, "back-driving": 2, "locked": 3}

# Columns of `simulate` under the names of the unit where those differ.
NAMES = {
    "groove_friction": ("groove_torque", "groove_force"),
    "ball_friction": ("ball_torque", "ball_force"),
}

# What `simulate` tells of the start of a sample: the output before the step.
BEFORE = ("nut_angle", "travel", "nut_position")
# The same of a mechanism.
MOVED = ("nut_speed", "friction_torque")


def bits(value):
    return struct.pack("<d", value)


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text, variable):
    """A number of a table: in single precision where the variable has it."""
    if variable.type == "Enumeration":
        return float(REGIMES[text])
    return float(np.float32(text)) if single(variable) else float(text)


def single(variable):
    doubles = ("nut_angle", "travel", "nut_position", "time")
    if variable.type == "Float32":
        return True
    return variable.type == "Real" and variable.causality == "output" and not (
        variable.name in doubles or variable.description == "angular speed of the nut"
    )


def pairs(unit, columns):
    """Columns of the table with the outputs that they are."""
    found = {}
    for column in columns:
        for name in (column, *NAMES.get(column, ())):
            variable = unit.variables.get(name)
            if variable is not None and variable.causality == "output":
                found[column] = name
    return found


def lockstep(unit, rows, start, ticks=1, tick=None):
    """Steps a unit through the rows of a table; how many outputs were compared."""
    instance = Instance(unit).initialise(start=float(rows[0]["time"]), **start)
    inputs = [name for name in unit.names("input") if name in rows[0]]
    columns = pairs(unit, rows[0])
    times = [float(row["time"]) for row in rows]
    step = times[1] - times[0]
    compared = 0
    before = instance.outputs()
    for row, time in zip(rows, times):
        instance.set(**{name: float(row[name]) for name in inputs})
        if ticks == 1:
            instance.step(time, step)
        else:
            # `simulate` tells the first of a sample's ticks.
            instance.step(time, tick)
        after = instance.outputs()
        for column, name in columns.items():
            variable = unit.variables[name]
            first = name in BEFORE or (name in MOVED and "motor_torque" in inputs)
            own = float((before if first else after)[name])
            want = number(row[column], variable)
            if ticks > 1 and first:
                assert abs(own - want) <= 1e-12 * max(1.0, abs(want)), (column, row, own)
            else:
                assert bits(own) == bits(want), (column, row, own, want)
            compared += 1
        for index in range(1, ticks):
            instance.step(time + index * tick, tick)
        before = instance.outputs()
    instance.close()
    return compared, sorted(columns)


def simulated(unit, rows, start, mean=True):
    """The same by `simulate_fmu`, FMPy's own loop; the sums of steps that it makes of the motion differ in their last bits."""
    inputs = [name for name in unit.names("input") if name in rows[0]]
    table = np.array(
        [tuple(float(row[name]) for name in ("time", *inputs)) for row in rows],
        dtype=[(name, float) for name in ("time", *inputs)],
    )
    step = float(rows[1]["time"]) - float(rows[0]["time"])
    result = fmpy.simulate_fmu(
        unit.path,
        input=table,
        start_values=start,
        start_time=float(rows[0]["time"]),
        stop_time=float(rows[0]["time"]) + step * len(rows),
        output_interval=step,
        output=unit.names("output"),
        fmi_type="CoSimulation",
    )
    assert len(result) == len(rows) + 1, (len(result), len(rows))
    compared = 0
    for index, row in enumerate(rows):
        for column, name in pairs(unit, rows[0]).items():
            first = name in BEFORE or (name in MOVED and "motor_torque" in inputs)
            own = float(result[name][index if first else index + 1])
            want = number(row[column], unit.variables[name])
            if first and name not in ("nut_position", "friction_torque"):
                # A sum of as many products as rows: each step is off by two roundings of the time at its ends.
                bound = len(rows) * 2.0**-52 * max(1.0, float(rows[-1]["time"]) / step)
                assert abs(own - want) <= bound * max(1.0, abs(want)), (column, row, own)
            else:
                assert bits(own) == bits(want), (column, row, own, want)
            compared += 1
    return compared
