"""Measurement files written and read by asammdf, against the built program: `check.py PROGRAM`.

What the program makes of a measurement file must equal, to the last bit, what it makes of a table with the same numbers.
"""

import csv
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from asammdf import MDF, Signal

PROGRAM = Path(sys.argv[1]).resolve()
FOLDER = Path(tempfile.mkdtemp(prefix="mdf4-"))
TAU = 2.0 * np.pi


def run(*arguments, data=None):
    """The program's exit code, standard output and standard error."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], input=data, capture_output=True, cwd=FOLDER, timeout=120)
    return done.returncode, done.stdout, done.stderr.decode()


def table(name, columns):
    """Writes a table; a float's repr is its value."""
    path = FOLDER / name
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        for row in zip(*columns.values()):
            writer.writerow([repr(float(value)) for value in row])
    return path


def signal(name, values, times, unit="", **more):
    return Signal(samples=np.asarray(values), timestamps=np.asarray(times), name=name, unit=unit, **more)


def measurement(name, *groups, compression=0):
    """Writes a measurement file with a group for each list of signals."""
    path = FOLDER / name
    with MDF(version="4.10") as file:
        for number, group in enumerate(groups):
            file.append(group, comment=f"group {number}", common_timebase=True)
            file.groups[-1].channel_group.acq_name = f"raster {number}"
        file.save(path, overwrite=True, compression=compression)
    return path


def simulated(trace, *more):
    """The table that the program makes of a trace."""
    code, out, err = run("simulate", "--design", "lin-4.1", "--input", trace, "--output", "-", *more)
    assert code == 0, err
    return out, err


def refused(*arguments, word, data=None):
    code, _, err = run(*arguments, data=data)
    assert code == 1 and word in err, f"{arguments}: {code} {err}"


def motion(samples=4000, tick=1e-3):
    time = tick * np.arange(samples)
    speed = 40.0 * np.sin(TAU * 0.7 * time) + 3.0 * np.sin(TAU * 5.1 * time)
    load = 6000.0 * np.sin(TAU * 0.35 * time + 0.4) + 500.0
    return time, speed, load


def same(name, columns, *groups, compression=0, more=()):
    """A measurement file and a table of its values make the same run."""
    expected, _ = simulated(table(f"{name}.csv", columns))
    got, notes = simulated(measurement(f"{name}.mf4", *groups, compression=compression), *more)
    assert got == expected, f"{name}: the runs differ\n{notes}"
    return notes


def values_and_units():
    time, speed, load = motion()
    si = {"time": time, "nut_speed": speed, "axial_load": load}
    channels = [signal("axial_load", load, time, "N"), signal("nut_speed", speed, time, "rad/s")]
    for compression in range(3):
        same(f"plain{compression}", si, channels, compression=compression)
    other = {"time": time, "nut_speed_rpm": speed, "axial_load_kN": load}
    for unit in ["rpm", "1/min", "U/min", "RPM"]:
        same("units", other, [signal("nut_speed", speed, time, unit), signal("axial_load", load, time, "kN")])
    degrees = {"time": time, "nut_speed (deg/s)": speed, "axial_load": load}
    same("degrees", degrees, [signal("nut_speed", speed, time, "\u00b0/s"), signal("axial_load", load, time, "N")])
    # Longer than one data block of any writer.
    time, speed, load = motion(300_000)
    same("long", {"time": time, "nut_speed": speed, "axial_load": load},
         [signal("axial_load", load, time, "N"), signal("nut_speed", speed, time, "rad/s")], compression=2)
    print("values and units: plain, deflated, transposed, rpm, deg/s, kN, 300,000 samples")


def scaled_integers():
    time, speed, load = motion()
    raw_speed = np.round(speed / 0.0125).astype("<i2")
    raw_load = np.round((load + 20_000.0) / 0.5).astype("<u2")
    conversion = {"a": 0.0125, "b": 0.0}, {"a": 0.5, "b": -20_000.0}
    groups = [
        signal("nut_speed", raw_speed, time, "rad/s", conversion=conversion[0]),
        signal("axial_load", raw_load, time, "N", conversion=conversion[1]),
        signal("status", (raw_load % 7).astype("u1"), time),
    ]
    path = measurement("scaled.mf4", groups)
    with MDF(path) as file:
        physical = {name: file.get(name).physical().samples for name in ("nut_speed", "axial_load")}
    same("scaled", {"time": time, **physical}, groups, compression=2)
    big = [
        signal("nut_speed", raw_speed.astype(">i2"), time, "rad/s", conversion=conversion[0]),
        signal("axial_load", raw_load.astype(">u4"), time, "N", conversion=conversion[1]),
    ]
    same("big", {"time": time, **physical}, big)
    single = speed.astype("f4")
    same("single", {"time": time, "nut_speed": single.astype("f8"), "axial_load": load},
         [signal("nut_speed", single, time, "rad/s"), signal("axial_load", load, time, "N")])
    print("scaled integers: signed, unsigned, of either byte order; float32")


def rasters():
    time, speed, load = motion()
    slow, slow_load = time[::10] + 3.3e-4, load[::10]
    place = np.clip(np.searchsorted(slow, time, side="right"), 1, len(slow) - 1)
    low, high = slow_load[place - 1], slow_load[place]
    share = (time - slow[place - 1]) / (slow[place] - slow[place - 1])
    held = np.where(time < slow[0], slow_load[0], np.where(time >= slow[-1], slow_load[-1], low + share * (high - low)))
    covered = time <= slow[-1] + np.median(np.diff(slow))
    notes = same(
        "rasters",
        {"time": time[covered], "nut_speed": speed[covered], "axial_load": held[covered]},
        [signal("nut_speed", speed, time, "rad/s")],
        [signal("axial_load", slow_load, slow, "N")],
    )
    assert "interpolated linearly" in notes, notes
    short = measurement("short.mf4", [signal("nut_speed", speed, time, "rad/s")],
                        [signal("axial_load", slow_load[:200], slow[:200], "N")])
    refused("simulate", "--design", "lin-4.1", "--input", short, "--output", "-", word="at least 90 %")
    hole = np.delete(np.arange(len(slow)), slice(100, 130))
    holed = measurement("holed.mf4", [signal("nut_speed", speed, time, "rad/s")],
                        [signal("axial_load", slow_load[hole], slow[hole], "N")])
    refused("simulate", "--design", "lin-4.1", "--input", holed, "--output", "-", word="a gap of 0.3100 s")
    print("rasters: 1 kHz and 100 Hz, too short, with a gap")


def invalid_samples():
    time, speed, load = motion()
    bad = np.zeros(len(time), dtype=bool)
    bad[[700, 701, 2500]] = True
    groups = [signal("nut_speed", speed, time, "rad/s"),
              signal("axial_load", np.where(bad, 1e9, load), time, "N", invalidation_bits=bad)]
    columns = {"time": time[~bad], "nut_speed": speed[~bad], "axial_load": load[~bad]}
    notes = same("invalid", columns, groups)
    assert "3 of 4000 samples are marked invalid" in notes, notes
    same("invalid_packed", columns, groups, compression=2)
    bad[:200] = True
    many = [signal("nut_speed", speed, time, "rad/s"), signal("axial_load", load, time, "N", invalidation_bits=bad)]
    path = measurement("many.mf4", many)
    refused("simulate", "--design", "lin-4.1", "--input", path, "--output", "-", word="203 of 4000 samples")
    print("invalid samples: left out, or refused with their count")


def names():
    time, speed, load = motion(500)
    own = [signal("Spd", speed, time, "rad/s"), signal("F", load, time, "N")]
    again = [signal("F", 0.5 * load, time, "N")]
    mapping = FOLDER / "mapping.toml"
    mapping.write_text('nut_speed = "Spd"\naxial_load = { channel = "F", group = "raster 1" }\n')
    same("mapped", {"time": time, "nut_speed": speed, "axial_load": 0.5 * load}, own, again, more=("--channels", mapping))
    command = ["simulate", "--design", "lin-4.1", "--output", "-", "--input"]
    refused(*command, measurement("names.mf4", own, again), word="the file's 3 channels are Spd, F, F")
    mapping.write_text('nut_speed = "Spd"\naxial_load = "F"\n')
    refused(*command, FOLDER / "names.mf4", "--channels", mapping, word="is there 2 times")
    speeds = [signal("nut_speed", speed, time, "rad/s")]
    refused(*command, measurement("missing.mf4", speeds), word="channel axial_load is missing")
    refused(*command, measurement("lbf.mf4", [*speeds, signal("axial_load", load, time, "lbf")]),
            word='its unit "lbf" is not accepted; accepted are N, kN')
    refused(*command, measurement("metres.mf4", [signal("nut_speed", speed, time, "km/h"), own[1]]),
            word="accepted are rad/s, deg/s, rpm, rps")
    silent = measurement("silent.mf4", [*speeds, signal("axial_load", load, time)])
    refused(*command, silent, word="the file says no unit")
    mapping.write_text('nut_speed = "nut_speed"\naxial_load = { channel = "axial_load", unit = "kN" }\n')
    same("said", {"time": time, "nut_speed": speed, "axial_load_kN": load},
         [*speeds, signal("axial_load", load, time)], more=("--channels", mapping))
    words = signal("axial_load", np.array([b"on", b"off"] * 250), time, "N", encoding="utf-8")
    refused(*command, measurement("words.mf4", [*speeds, words]), word="no numbers")
    nan = load.copy()
    nan[17] = np.nan
    _, err = simulated(measurement("nan.mf4", [*speeds, signal("axial_load", nan, time, "N")]))
    assert "channel axial_load: 1 of 500 samples are marked invalid or are NaN or infinite" in err, err
    refused(*command, FOLDER / "mapped.csv", "--channels", mapping, word="is a table")
    print("names: mapping with group and unit; missing, twice, without unit, with one that does not convert; NaN is missing")


def calibration():
    time = 1e-3 * np.arange(4_000)
    rng = np.random.default_rng(7)
    position = 0.05 * np.sin(TAU * 0.5 * time) + 0.01 * np.sin(TAU * 1.7 * time + 0.3)
    speed, acceleration = np.gradient(position, time), np.gradient(np.gradient(position, time), time)
    force = 20.0 * acceleration + 60.0 * np.tanh(speed / 2e-3) + 100.0 * speed + rng.normal(0.0, 0.5, len(time))
    force = np.round(force, 3)
    kept = np.ones(len(time), dtype=bool)
    kept[[400, 401, 1500, 1501, 1502, 3000]] = False
    channels = {"position": (1e3 * position, "mm"), "motor_force": (force, "N")}

    def both(name, rows, units=("position_mm", "motor_force")):
        columns = {"time": time[rows], units[0]: channels["position"][0][rows], units[1]: force[rows]}
        group = [signal(key, value[rows], time[rows], unit) for key, (value, unit) in channels.items()]
        return table(f"{name}.csv", columns), measurement(f"{name}.mf4", group, compression=1)

    def answer(*arguments):
        code, out, err = run("calibrate", *arguments, "--json", "--output", FOLDER / "page")
        assert code == 0, err
        return json.loads(out)

    whole = both("whole", np.ones(len(time), dtype=bool))
    gaps = both("gaps", kept)
    expected = answer(gaps[0])
    assert expected["parameters"], "nothing was told"
    assert answer(gaps[1]) == expected
    assert answer(whole[1], "--validate", gaps[1]) == answer(whole[0], "--validate", gaps[0])
    # Invalid samples are gaps; a long gap is refused in the same words.
    invalid = [signal("position", channels["position"][0], time, "mm", invalidation_bits=~kept),
               signal("motor_force", force, time, "N")]
    assert answer(measurement("marked.mf4", invalid)) == expected, "invalid samples are no gaps"
    kept[2000:2100] = False
    for path in both("long_gap", kept):
        refused("calibrate", path, "--json", word="a gap of 0.1010 s after 1.999 s")
    # A folder of traces of both kinds.
    for ending in ("csv", "mf4"):
        folder = FOLDER / f"traces_{ending}"
        folder.mkdir()
        for number, path in enumerate([whole, gaps]):
            (folder / f"{number}.{ending}").write_bytes(path[ending == "mf4"].read_bytes())
    answers = []
    for ending in ("csv", "mf4"):
        code, out, err = run("calibrate", FOLDER / f"traces_{ending}", "--json", "--output", FOLDER / f"told_{ending}")
        assert code == 0, err
        answers.append(out.decode().replace(".mf4", ".csv"))
    assert answers[0] == answers[1]
    print("calibrate: whole, with gaps, invalid samples, validated, a folder")


def written():
    code, _, err = run("simulate", "--manoeuvre", "parking", "--output", "out.csv")
    assert code == 0, err
    code, _, err = run("simulate", "--manoeuvre", "parking", "--output", "out.mf4", "--reference")
    assert code == 0, err
    code, _, err = run("simulate", "--manoeuvre", "parking", "--output", "reference.csv", "--reference")
    assert code == 0, err
    with (FOLDER / "reference.csv").open() as file:
        rows = list(csv.DictReader(file))
    units = {"nut_speed": "rad/s", "axial_load": "N", "friction_torque": "Nm", "efficiency": "", "time": "s"}
    with MDF(FOLDER / "out.mf4") as file:
        assert file.version == "4.10"
        master = np.array([float(row["time"]) for row in rows])
        for name in rows[0]:
            if name == "time":
                continue
            found = file.get(name)
            assert found.timestamps.tobytes() == master.tobytes(), name
            assert found.comment, name
            if name in ("regime", "fault_words"):
                texts = [text.decode() if isinstance(text, bytes) else text for text in found.samples]
                assert texts == [row[name] for row in rows]
            else:
                expected = np.array([float(row[name]) for row in rows])
                assert found.samples.astype("f8").tobytes() == expected.tobytes(), name
            assert found.unit == units.get(name, found.unit), name
        assert file.masters_db and file.get("efficiency").unit == ""
        history = file.file_history[0]
        assert "epas" in history.comment, history.comment
    # Ours back into the program: what it says of its own columns is what it reads.
    again, _ = simulated(FOLDER / "out.mf4")
    expected, _ = simulated(FOLDER / "out.csv")
    assert again == expected
    # Beyond one data block.
    trace = table("many.csv", dict(zip(("time", "nut_speed", "axial_load"), motion(90_000))))
    code, _, err = run("simulate", "--design", "lin-4.1", "--input", trace, "--output", "many_out.mf4")
    assert code == 0, err
    expected = np.array([float(row["friction_torque"]) for row in csv.DictReader(simulated(trace)[0].decode().splitlines())])
    with MDF(FOLDER / "many_out.mf4") as file:
        assert file.get("friction_torque").samples.tobytes() == expected.tobytes()
    # Standard input and output.
    data = (FOLDER / "out.mf4").read_bytes()
    code, out, err = run("simulate", "--design", "lin-4.1", "--input", "-", "--output", "-", data=data)
    assert code == 0 and out == again, err
    refused("simulate", "--manoeuvre", "parking", "--output", "out.mf4", word="--force")
    print("written: values, master, units and comments of", len(rows[0]), "channels; 90,000 samples; standard input and output")


def spoiled():
    time, speed, load = motion(2000)
    path = measurement("good.mf4", [signal("nut_speed", (speed / 0.01).astype("i2"), time, "rad/s", conversion={"a": 0.01, "b": 0.0})],
                       [signal("axial_load", load, time, "N")], compression=2)
    good = path.read_bytes()
    command = ["simulate", "--design", "lin-4.1", "--output", "-", "--input"]
    generator = random.Random(11)
    trials = [good[:length] for length in [0, 1, 8, 63, 64, 100, 168, *(generator.randrange(len(good)) for _ in range(60))]]
    for _ in range(120):
        bytes_ = bytearray(good)
        for _ in range(generator.randrange(1, 5)):
            # Links and counts stand among the first bytes and behind the data.
            bytes_[generator.randrange(len(bytes_))] = generator.choice([0, 1, 0x7F, 0x80, 0xFF, generator.randrange(256)])
        trials.append(bytes(bytes_))
    ends = {0: 0, 1: 0}
    spoiled_path = FOLDER / "spoiled.mf4"
    for trial in trials:
        spoiled_path.write_bytes(trial)
        code, _, err = run(*command, spoiled_path)
        assert code in ends and "panicked" not in err, f"{code}: {err}"
        ends[code] += 1
    refused(*command, FOLDER / "nothing.mf4", word="cannot open")
    spoiled_path.write_bytes(b"UnFinMF " + good[8:])
    refused(*command, spoiled_path, word="not closed")
    spoiled_path.write_bytes(good[:8] + b"3.30    " + good[16:])
    refused(*command, spoiled_path, word="MDF 4")
    spoiled_path.write_text("time,nut_speed\n0,1\n")
    refused(*command, spoiled_path, word="no measurement file")
    print(f"spoiled: {len(trials)} files cut off or damaged, {ends[1]} refused, none ends the program otherwise")


for check in (values_and_units, scaled_integers, rasters, invalid_samples, names, calibration, written, spoiled):
    check()
