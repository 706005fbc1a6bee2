"""StarCell in FreeCAD: parametric solids whose mesh is proved, for macros and for the workbench.

    import starcell_workbench as scw
    obj = scw.make_union([doc.Box, doc.Sphere], error="0.1 mm")
    obj.Mesh, obj.Verdict, obj.ErrorBound, obj.Components, obj.Genus, obj.Certificate
    scw.make_rescue(doc.Fusion).Agrees
    scw.make_offset(doc.Box, "-0.3 mm"), scw.make_shell(doc.Box, 2)
    scw.make_minkowski_sum(doc.Plate, doc.Tool), scw.make_erode(doc.Pocket, doc.Tool)
    scw.make_penetration_depth(doc.Shaft, doc.Bearing).Report
    scw.make_simplified(doc.Scan, error="0.05 mm").TrianglesBefore
    scw.make_repaired(doc.Scan).Flaws
    scw.make_configuration_space(doc.Key, doc.Lock).FreeComponents
    scw.make_solid(obj).Shape

Works with and without the GUI. The package holds no geometry: it hands FreeCAD's objects to the engine `starcell`
and its results back. Documents store class paths of this package, so it is always imported by this one name.
"""
from .macros import (make_closing, make_configuration_space, make_cut, make_erode, make_free_positions, make_intersection, make_minkowski_sum, make_offset, make_opening,
                     make_penetration_depth, make_remeshed, make_repaired, make_rescue, make_shell, make_simplified, make_solid, make_union)

__all__ = ["make_closing", "make_configuration_space", "make_cut", "make_erode", "make_free_positions", "make_intersection", "make_minkowski_sum", "make_offset", "make_opening",
           "make_penetration_depth", "make_remeshed", "make_repaired", "make_rescue", "make_shell", "make_simplified", "make_solid", "make_union"]
