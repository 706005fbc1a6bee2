"""The command that makes a solid of a mesh: when it is offered, what it leaves in the document, and its undo."""
import FreeCADGui
import window

import starcell_workbench as scw


class ToSolid(window.WindowTest):
    def setUp(self):
        super().setUp()
        self.doc, self.plate, self.rib, bore = window.block_with_bore()
        self.result = scw.make_union([self.plate, self.rib])

    def test_needs_one_mesh(self):
        command = FreeCADGui.Command.get("StarCell_ToSolid")
        for picked, wanted in (((), False), ((self.plate,), False), ((self.result,), True), ((self.result, self.plate), False)):
            window.select(*picked)
            self.assertEqual(command.isActive(), wanted)

    def test_makes_a_solid_and_undo_takes_it_back(self):
        window.select(self.result)
        FreeCADGui.runCommand("StarCell_ToSolid")
        window.pump()
        solid = self.doc.ActiveObject
        self.assertTrue(solid.isValid(), solid.getStatusString())
        self.assertTrue(solid.Shape.isValid())
        self.assertEqual(solid.Faces, 11)  # the plate's six, the rib's other five
        self.assertEqual(solid.ViewObject.Proxy.claimChildren(), [self.result])
        self.assertFalse(self.result.ViewObject.Visibility)
        self.assertTrue(solid.ViewObject.Visibility)
        window.look(self.doc)
        window.shot("to_solid", self.doc)
        name = solid.Name
        self.doc.undo()
        window.pump()
        self.assertIsNone(self.doc.getObject(name))
        self.assertTrue(self.result.ViewObject.Visibility)
