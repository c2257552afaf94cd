"""Explicit enthalpy method on equal cells of a slab or a box: an external solver of meltfront, with numpy.

dE/dt = div(k grad T), E the enthalpy per volume, zero of the solid at the melting temperature T_m:
T = T_m + E/(rho c_s) below zero, T_m up to rho L, T_m + (E - rho L)/(rho c_l) beyond.
"""
import json
import sys

import numpy as np

request = json.load(sys.stdin)
scene, n = request["scene"], request["n"]
material, domain = scene["material"], scene["domain"]
melting, latent = material["melting_temperature"]["value"], material["latent_heat"]["value"]
solid, liquid = ({key: value["value"] for key, value in material[phase].items()} for phase in ("solid", "liquid"))
rho, latent = solid["density"], solid["density"] * latent
capacity_solid, capacity_liquid = rho * solid["specific_heat_capacity"], rho * liquid["specific_heat_capacity"]
lower, upper = (np.array(domain[corner]["values"]) for corner in ("lower", "upper"))
h = domain["side"]["value"] / n
shape = tuple(int(round(cells)) for cells in (upper - lower) / h)  # cells in x, y
if not np.allclose(np.array(shape) * h, upper - lower):
    print(json.dumps({"kind": "refused", "reason": f"n = {n} gives no whole number of cells in every direction"}))
    sys.exit()
dimension = len(shape)
centres = np.meshgrid(*(low + h * (np.arange(m) + 0.5) for low, m in zip(lower, shape)), indexing="ij")
# Samples have x first; cells are kept as [x, y] and told with x first, too.
row = lambda values: np.asarray(values).flatten(order="F").tolist()


def sampled(field, time, over):
    """A field's values at a time, over an array of cells."""
    if field["constant"]:
        return np.full(over, field["value"])
    times, values = field["samples"]["times"], np.array(field["samples"]["values"], dtype=float)
    i = min(np.searchsorted(times, time, side="right"), len(times) - 1)
    share = (time - times[i - 1]) / (times[i] - times[i - 1]) if i > 0 else 0
    return ((1 - share) * values[max(i - 1, 0)] + share * values[i]).reshape(over, order="F")


def state_of(enthalpy):
    """Temperature and solid fraction."""
    temperature = melting + np.minimum(enthalpy, 0) / capacity_solid + np.maximum(enthalpy - latent, 0) / capacity_liquid
    fraction = np.clip(1 - enthalpy / latent, 0, 1) if latent > 0 else np.where(enthalpy < 0, 1.0, 0.0)
    return temperature, fraction


def change(enthalpy, time):
    """Heat that enters each cell per volume and time, and all that enters through walls per time."""
    temperature, fraction = state_of(enthalpy)
    conductivity = fraction * solid["conductivity"] + (1 - fraction) * liquid["conductivity"]
    rate, entering = np.zeros(shape), 0.0
    for d in range(dimension):
        T, k, into = (np.moveaxis(a, d, 0) for a in (temperature, conductivity, rate))
        flux = 2 * k[1:] * k[:-1] / (k[1:] + k[:-1]) * (T[1:] - T[:-1]) / h  # towards smaller coordinates
        into[:-1] += flux / h
        into[1:] -= flux / h
        for end, name in ((0, "xyz"[d] + "_min"), (-1, "xyz"[d] + "_max")):
            wall = scene["walls"][name]
            if wall["kind"] == "fixed temperature":
                through = 2 * k[end] * (sampled(wall["temperature"], time, T[end].shape) - T[end]) / h
            elif wall["kind"] == "flux":
                through = sampled(wall["flux"], time, T[end].shape)
            else:
                continue
            into[end] += through / h
            entering += through.sum() * h ** (dimension - 1)
    return rate, entering


start, times = scene["start_time"]["value"], request["times"]["values"]
initial = sampled(scene["initial"]["temperature"], start, shape)
melted = latent * (1 - scene["initial"]["solid_fraction_at_melting"]["value"])
enthalpy = np.where(initial < melting, capacity_solid * (initial - melting),
                    np.where(initial > melting, latent + capacity_liquid * (initial - melting), melted))
diffusivity = max(solid["conductivity"], liquid["conductivity"]) / min(capacity_solid, capacity_liquid)
# A cell in a corner exchanges with a neighbour and, over half the distance, with a wall in each direction.
longest = request["options"]["step_factor"] * h * h / (3 * dimension * diffusivity)
volume, steps, through_walls, time = h**dimension, 0, 0.0, start
print(json.dumps({"kind": "start", "protocol": 1, "spacing": h, "time_step": longest, "unknowns": enthalpy.size,
                  "positions": [row(axis) for axis in centres], "weights": [volume] * enthalpy.size}))
for wanted in times:
    count = int(np.ceil((wanted - time) / longest))
    begin, dt = time, (wanted - time) / max(count, 1)
    for i in range(count):
        rate, entering = change(enthalpy, begin + (i + 0.5) * dt)
        enthalpy, through_walls = enthalpy + dt * rate, through_walls + dt * entering
    time, steps = wanted, steps + count
    temperature, fraction = state_of(enthalpy)
    capacity = fraction * capacity_solid + (1 - fraction) * capacity_liquid
    heat = {"stored": volume * float((capacity * (temperature - melting)).sum()),
            "latent": volume * latent * float((1 - fraction).sum()), "boundary": float(through_walls), "sources": 0}
    print(json.dumps({"kind": "snapshot", "time": time, "temperature": row(temperature),
                      "solid_fraction": row(fraction), "heat": heat}))
print(json.dumps({"kind": "end", "steps": steps, "work": 2 * dimension * enthalpy.size * steps}))
