"""OpenCASCADE's own answer to what cad.py asks: a shape cut by a moved copy of itself, in FreeCAD without a window.

Not a test by itself: run by cad.py as `./run freecadcmd occ_cut.py SHAPE ANSWER X Y Z`; run alone it says so and succeeds."""
import json
import sys


def main(shape_file, answer_file, *move):
    import FreeCAD
    import Part

    shape = Part.Shape()
    shape.read(shape_file)
    whole = shape.Solids[0] if len(shape.Solids) == 1 else shape.Solids[0].multiFuse(shape.Solids[1:])
    moved = whole.copy()
    moved.translate(FreeCAD.Vector(*map(float, move)))
    try:
        cut = whole.cut(moved)
        answer = {"valid": bool(whole.isValid() and cut.isValid() and whole.Volume > 0 and cut.Volume >= 0), "volume": cut.Volume}
    except Part.OCCError as error:
        answer = {"valid": False, "reason": str(error)}
    with open(answer_file, "w") as out:
        json.dump(answer, out)


if len(sys.argv) == 6:
    main(*sys.argv[1:])
else:
    print("occ_cut.py is a part of cad.py")
    print("0 passed, 0 failed")
