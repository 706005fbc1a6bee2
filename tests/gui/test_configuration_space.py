"""Configuration spaces from the toolbar, with a picture."""
import FreeCADGui
import window
from FreeCAD import Vector

import starcell_workbench as scw


class ConfigurationSpaces(window.WindowTest):
    def test_of_a_bar_among_posts(self):
        def post(name, size, at):
            box = self.doc.addObject("Part::Box", name)
            box.Length, box.Width, box.Height, box.Placement.Base = *size, 2, Vector(*at)
            return box

        self.doc = window.block_with_bore()[0]
        for each in self.doc.Objects:
            each.Visibility = False
        bar, one, two = post("Bar", (14, 3), (-40, -20, 0)), post("One", (10, 20), (0, 6, 0)), post("Two", (10, 20), (0, -26, 0))
        self.doc.recompute()
        window.select(bar, one, two)
        FreeCADGui.runCommand("StarCell_ConfigurationSpace")
        window.pump()
        space = self.doc.ActiveObject
        self.assertTrue(space.isValid(), space.getStatusString())
        self.assertEqual((space.Robot, space.Obstacles, space.FreeComponents), (bar, [one, two], 1))
        self.assertTrue(bar.Visibility)
        self.assertEqual(space.ViewObject.Proxy.claimChildren(), [])
        space.ViewObject.Transparency = 50
        window.look(self.doc)
        window.shot("configuration-space", self.doc)
        bar.Width = 13   # the gap is 12
        self.doc.recompute()
        self.assertEqual(space.FreeComponents, 1)   # round the posts it passes

