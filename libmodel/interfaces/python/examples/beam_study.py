# %% [markdown]
# Load over deflection of the notched beam with particles of three sizes, against a straight crack in finite elements:
# python3 beam_study.py DATA OUT.png. Ctrl-C stops it.

# %%
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
import numpy

import fpz

data = pathlib.Path(sys.argv[1])
rows = [line for line in open(data / "reference" / "beam_3pb_rollers_8mm.csv") if not line.startswith("#")]
reference = numpy.genfromtxt(rows, delimiter=",", names=True)


# %%
def show(info):
    print(f"\r{100 * info['fraction']:5.1f} %  load {info['load']:7.1f} N", end="", flush=True)


figure, axes = pyplot.subplots(figsize=(7, 4.5), layout="constrained")
axes.plot(reference["deflection_mid_depth"], reference["load"], color="0.6", linewidth=3, label="straight crack")
for spacing in (0.008, 0.005, 0.004):
    overrides = {"spacing": spacing, "output.frames": 0}
    result = fpz.run_scene(data / "scenes" / "beam_3pb.json", overrides=overrides, progress=show)
    peak = result.summary["peak_load"]
    print(f"\rspacing {1e3 * spacing:g} mm: peak {peak:.0f} N, {100 * (peak / reference['load'].max() - 1):+.1f} %")
    fpz.plot.history(result, "deflection", "load", axes=axes, label=f"particles, {1e3 * spacing:g} mm")
axes.set_xlim(0, 8e-5)
axes.set_xlabel("deflection, m")
axes.set_ylabel("load, N")
axes.legend()
figure.savefig(sys.argv[2], dpi=90)
