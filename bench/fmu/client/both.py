"""One face for FMPy's classes of FMI 2.0 and 3.0."""

import ctypes
from dataclasses import dataclass, field

import fmpy
from fmpy import fmi2, fmi3
from fmpy.fmi1 import FMICallException

__all__ = ["FMICallException", "Instance", "Unit"]


@dataclass
class Unit:
    """A unit's file, unpacked, with its model description."""

    path: str
    folder: str = field(init=False)

    def __post_init__(self):
        self.description = fmpy.read_model_description(self.path)
        self.folder = fmpy.extract(self.path)
        self.version = int(self.description.fmiVersion[0])
        self.variables = {v.name: v for v in self.description.modelVariables}

    def names(self, causality):
        return [v.name for v in self.variables.values() if v.causality == causality]


class Instance:
    """An instance of a unit, by names of variables; texts of the logger in `said`."""

    def __init__(self, unit, name="friction", token=None, logging=True):
        self.unit = unit
        self.said = []
        model = unit.description
        make = fmi2.FMU2Slave if unit.version == 2 else fmi3.FMU3Slave
        self.fmu = make(
            guid=token or model.guid,
            unzipDirectory=unit.folder,
            modelIdentifier=model.coSimulation.modelIdentifier,
            instanceName=name,
        )
        if unit.version == 2:
            callbacks = fmi2.fmi2CallbackFunctions()
            callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(
                lambda _environment, _name, status, _category, message: self.said.append(
                    (status, message.decode())
                )
            )
            callbacks.allocateMemory = fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
            callbacks.freeMemory = fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
            self.callbacks = callbacks
            self.fmu.instantiate(callbacks=callbacks, loggingOn=logging)
        else:
            self.fmu.instantiate(
                loggingOn=logging,
                logMessage=lambda _environment, status, _category, message: self.said.append(
                    (status, message.decode())
                ),
            )

    def initialise(self, start=0.0, **values):
        if self.unit.version == 2:
            self.fmu.setupExperiment(startTime=start)
            self.set(**values)
            self.fmu.enterInitializationMode()
        else:
            self.set(**values)
            self.fmu.enterInitializationMode(startTime=start)
        self.fmu.exitInitializationMode()
        return self

    def _kind(self, variable):
        kind = variable.type
        if self.unit.version == 2:
            return {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer"}[kind]
        return {"Enumeration": "Int64"}.get(kind, kind)

    def set(self, **values):
        for name, value in values.items():
            self.set_one(name, value)

    def set_one(self, name, value):
        variable = self.unit.variables[name]
        getattr(self.fmu, "set" + self._kind(variable))([variable.valueReference], [value])

    def get(self, name):
        variable = self.unit.variables[name]
        return getattr(self.fmu, "get" + self._kind(variable))([variable.valueReference])[0]

    def outputs(self):
        return {name: self.get(name) for name in self.unit.names("output")}

    def step(self, time, size):
        return self.fmu.doStep(currentCommunicationPoint=time, communicationStepSize=size)

    def save(self):
        return self.fmu.getFMUstate() if self.unit.version == 2 else self.fmu.getFMUState()

    def restore(self, state):
        (self.fmu.setFMUstate if self.unit.version == 2 else self.fmu.setFMUState)(state)

    def free_state(self, state):
        (self.fmu.freeFMUstate if self.unit.version == 2 else self.fmu.freeFMUState)(state)

    def serialise(self, state):
        fmu = self.fmu
        return (fmu.serializeFMUstate if self.unit.version == 2 else fmu.serializeFMUState)(state)

    def deserialise(self, data):
        fmu = self.fmu
        call = fmu.deSerializeFMUstate if self.unit.version == 2 else fmu.deserializeFMUState
        return call(data)

    def raw(self, name):
        """A function of the shared library of its own, without FMPy's types and checks."""
        return self.fmu.dll[f"fmi{self.unit.version}{name}"]

    def component(self):
        return ctypes.c_void_p(self.fmu.component)

    def close(self):
        """Ends and frees the instance; the library stays loaded for the next one."""
        if self.fmu.component:
            (
                self.fmu.fmi2FreeInstance if self.unit.version == 2 else self.fmu.fmi3FreeInstance
            )(self.fmu.component)
            self.fmu.component = None
