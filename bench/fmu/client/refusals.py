"""Calls and values that a unit refuses: a status with a text, and nothing lost."""

import ctypes
import math

from both import FMICallException, Instance


class Refusals:
    """Calls that have to fail, with words that their text has to have."""

    def __init__(self, unit, start, step):
        self.unit, self.start, self.step = unit, start, step
        self.count = 0

    def instance(self):
        return Instance(self.unit)

    def ready(self):
        return self.instance().initialise(**self.start)

    def expect(self, instance, call, *words):
        instance.said.clear()
        try:
            call()
        except FMICallException as refusal:
            assert refusal.status == 3, refusal.status
            assert instance.said, "no text"
            text = instance.said[-1][1]
            for word in words:
                assert word in text, (word, text)
        else:
            raise AssertionError(f"not refused: {words}")
        self.count += 1

    def all(self):
        self.parameters()
        self.order()
        self.values()
        self.steps()
        self.inputs()
        self.ends()
        self.nulls()
        self.instances()
        return self.count

    def parameters(self):
        for name, value, words in (
            ("friction", -1.0, ("friction", "-1", "allowed")),
            ("friction", math.nan, ("friction", "NaN")),
            ("ball_radius", 5.0, ("ball_radius", "5", "allowed")),
            ("clearance", -3e-5, ("clearance", "4.2 GPa")),
            ("contact_angle", 0.0, ("contact_angle", "allowed")),
            ("groove_material.poisson_ratio", 0.9, ("groove_material.poisson_ratio", "0.9")),
            ("ball_material.density", math.inf, ("ball_material.density", "inf")),
            ("tick", 0.0, ("tick", "0", "allowed")),
            ("mean_load", -1.0, ("mean_load", "-1", "allowed")),
            ("inertia", 0.0, ("inertia", "0", "allowed")),
            ("loaded_balls", 0, ("loaded_balls", "0", "allowed")),
            ("branch", 7, ("branch", "7", "allowed")),
        ):
            if name not in self.unit.variables:
                continue
            one = self.instance()
            self.expect(one, lambda: one.initialise(**{**self.start, name: value}), *words)
            # It is told again with a good value, and goes on.
            good = float(self.unit.variables[name].start)
            one.set(**{name: int(good) if name in ("loaded_balls", "branch") else good})
            one.set(**self.start)
            one.fmu.exitInitializationMode()
            one.step(0.0, self.step)
            self.expect(one, lambda: one.set_one(name, value), name, "allowed: before")
            one.close()

    def order(self):
        one = self.instance()
        self.expect(one, lambda: one.step(0.0, self.step), "DoStep", "before initialisation")
        self.expect(one, lambda: one.fmu.exitInitializationMode(), "ExitInitializationMode")
        one.initialise(**self.start)
        self.expect(one, lambda: one.fmu.enterInitializationMode(), "InitializationMode")
        one.step(0.0, self.step)
        one.close()

    def values(self):
        one = self.ready()
        version, fmu = self.unit.version, one.fmu
        last = len(self.unit.variables)
        real = (fmu.getReal, fmu.setReal) if version == 2 else (fmu.getFloat64, fmu.setFloat64)
        self.expect(one, lambda: real[0]([last]), "value reference", str(last), "allowed: 0 to")
        self.expect(one, lambda: real[1]([2**32 - 1], [0.0]), "value reference", "4294967295")
        faults = self.unit.variables["faults"].valueReference
        self.expect(one, lambda: real[0]([faults]), "faults", "type")
        self.expect(one, lambda: fmu.getBoolean([faults]), "Boolean")
        friction = next(name for name in self.unit.names("output") if name.startswith("friction_"))
        self.expect(one, lambda: one.set_one(friction, 1.0), friction, "cannot be set")
        self.expect(one, lambda: one.set_one("time", 1.0), "time", "cannot be set")
        one.step(0.0, self.step)
        one.close()

    def steps(self):
        one = self.ready()
        step = self.step
        for size in (0.0, -step, math.nan, math.inf):
            self.expect(one, lambda: one.step(0.0, size), "communicationStepSize", "allowed: above 0")
        for time in (5.0, -1.0, math.nan):
            self.expect(one, lambda: one.step(time, step), "currentCommunicationPoint", "allowed")
        if "tick" in self.unit.variables:
            for size in (0.5 * step, 1.5 * step):
                self.expect(one, lambda: one.step(0.0, size), "communicationStepSize", "whole multiples")
            one.step(0.0, 3.0 * step)
        else:
            one.step(0.0, 1.7 * step)
            one.step(1.7 * step, 1e-9)
        assert math.isclose(one.get("time"), 3.0 * step if "tick" in self.unit.variables else 1.7 * step + 1e-9)
        one.close()

    def inputs(self):
        """NaN at an input: flagged with a warning where the scene goes on, refused where there is no motion under it."""
        for name in self.unit.names("input"):
            one = self.ready()
            good = {other: 1.0 for other in self.unit.names("input")}
            if "temperature" in good:
                good["temperature"] = 300.0
            one.set(**good)
            one.step(0.0, self.step)
            one.said.clear()
            one.set(**{name: math.nan})
            if name == "motor_torque":
                before = one.outputs()
                self.expect(one, lambda: one.step(self.step, self.step), name, "NaN", "finite")
                assert one.outputs() == before
            else:
                one.step(self.step, self.step)
                status, text = one.said[-1]
                assert status == 1 and name in text and "NaN" in text, one.said
                # A flag is told once.
                one.step(one.get("time"), self.step)
                assert len(one.said) == 1, one.said
                assert one.get("faults") != 0
                assert all(math.isfinite(float(value)) for value in one.outputs().values())
                self.count += 1
            one.set(**good)
            time = one.get("time")
            one.step(time, self.step)
            assert all(math.isfinite(float(value)) for value in one.outputs().values())
            if name != "motor_torque" and one.get("faults") == 0:
                # And told when it ends.
                status, text = one.said[-1]
                assert status == 0 and "no step any more" in text and len(one.said) == 2, one.said
            one.close()

    def ends(self):
        one = self.ready()
        name = self.unit.names("input")[0]
        one.step(0.0, self.step)
        one.fmu.terminate()
        self.expect(one, lambda: one.set_one(name, 1.0), name, "after its end")
        self.expect(one, lambda: one.step(self.step, self.step), "DoStep", "after its end")
        assert math.isclose(one.get("time"), self.step)
        one.close()
        # A handle that was freed is told from one that lives: no text, because its logger is gone.
        handle, dead = one.component(), self.instance()
        dead.close()
        reference = (ctypes.c_uint32 * 1)(self.unit.variables[name].valueReference)
        value = (ctypes.c_double * 1)(1.0)
        counts = (1,) if self.unit.version == 2 else (1, 1)
        setter = one.raw("SetReal" if self.unit.version == 2 else "SetFloat64")
        for wrong in (0, 1, 0x1000, 0xDEADBEEF):
            arguments = [ctypes.c_void_p(wrong), reference, ctypes.c_size_t(1), value]
            if len(counts) == 2:
                arguments.append(ctypes.c_size_t(1))
            # 0x1000 was the first handle of the process, and is free again.
            assert setter(*arguments) == 3, hex(wrong)
            self.count += 1
        del handle

    def nulls(self):
        one = self.ready()
        two = self.unit.version == 2
        null, count = ctypes.c_void_p(0), ctypes.c_size_t(1)
        more = () if two else (ctypes.c_size_t(1),)
        reference = (ctypes.c_uint32 * 1)(1)
        value = (ctypes.c_double * 1)(1.0)
        component = one.component()
        real = "Real" if two else "Float64"
        state = "FMUstate" if two else "FMUState"
        deserialise = "DeSerializeFMUstate" if two else "DeserializeFMUState"
        calls = [
            ("Get" + real, (component, null, count, value, *more)),
            ("Get" + real, (component, reference, count, null, *more)),
            ("Set" + real, (component, null, count, value, *more)),
            ("Set" + real, (component, reference, count, null, *more)),
            ("Get" + state, (component, null)),
            ("Set" + state, (component, null)),
            ("Set" + state, (component, ctypes.c_void_p(0x1230))),
            (f"Serialized{state}Size", (component, null, null)),
            (deserialise, (component, null, ctypes.c_size_t(9), null)),
            ("SetDebugLogging", (component, 1, ctypes.c_size_t(3), null)),
        ]
        if not two:
            calls.append(("GetFloat64", (component, reference, count, value, ctypes.c_size_t(2))))
            point = ctypes.c_double(0.0), ctypes.c_double(self.step)
            calls.append(("DoStep", (component, *point, ctypes.c_bool(True), null, null, null, null)))
        for name, arguments in calls:
            function = one.raw(name)
            one.said.clear()
            assert function(*arguments) == 3, name
            assert one.said, name
            self.count += 1
        one.step(0.0, self.step)
        one.close()

    def instances(self):
        try:
            Instance(self.unit, token="another token")
        except Exception:  # FMPy has no class of its own for this.
            self.count += 1
        else:
            raise AssertionError("another token was taken")
