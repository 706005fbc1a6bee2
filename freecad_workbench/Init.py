# FreeCAD runs this at every start, with and without a GUI. Nothing to register: the package `starcell_workbench`
# beside this file is on the path already, and the engine is loaded by the first operation that needs it.
