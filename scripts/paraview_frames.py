"""Draws the last frame of a run with ParaView: damage on the body where it has moved to, as frames.pvd gives it.

    pvbatch scripts/paraview_frames.py out/beam picture.png [field] [magnification]

(without a screen: xvfb-run -a pvbatch ...)

The field is that of the frames (default damage), displacements are magnified (default 100). In the ParaView program:
open frames.pvd, "Apply", Representation "Point Gaussian", and "Warp By Vector" with displacement.
"""
import sys

from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetAnimationScene, GetColorTransferFunction, GetScalarBar,
                             PVDReader, ResetCamera, SaveScreenshot, Show, UpdatePipeline, WarpByVector)


def main():
    folder, picture = sys.argv[1:3]
    field = sys.argv[3] if len(sys.argv) > 3 else "damage"
    magnification = float(sys.argv[4]) if len(sys.argv) > 4 else 100.0
    reader = PVDReader(FileName=folder + "/frames.pvd")
    times = list(reader.TimestepValues)
    UpdatePipeline(time=times[-1], proxy=reader)
    data = reader.GetPointDataInformation()
    fields = [data.GetArray(k).GetName() for k in range(data.GetNumberOfArrays())]
    print(f"{len(times)} frames up to {times[-1]:g} s, {reader.GetDataInformation().GetNumberOfPoints()} particles")
    print("fields:", ", ".join(fields))
    if field not in fields:
        sys.exit(f"no field {field}")
    moved = WarpByVector(Input=reader, Vectors=["POINTS", "displacement"], ScaleFactor=magnification)
    view = GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1200, 600]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    view.ViewTime = times[-1]
    GetAnimationScene().AnimationTime = times[-1]
    body = Show(moved, view)
    body.SetRepresentationType("Points")
    body.PointSize = 10
    ColorBy(body, ("POINTS", field))
    body.RescaleTransferFunctionToDataRange(True)
    body.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(GetColorTransferFunction(field), view)
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    view.InteractionMode = "2D"
    ResetCamera(view)
    view.CameraParallelScale *= 0.6
    SaveScreenshot(picture, view)
    print(picture)


main()
