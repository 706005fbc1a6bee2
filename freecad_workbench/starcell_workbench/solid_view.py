"""How a solid made of a mesh shows itself: its icon, and the mesh as its child."""
from . import resources
from .stateless import Stateless


class SolidView(Stateless):
    def __init__(self, vobj):
        vobj.Proxy = self

    def attach(self, vobj):
        self.obj = vobj.Object

    def getIcon(self):
        return resources.icon(self.obj.Proxy.command)

    def claimChildren(self):
        return [self.obj.Source] if self.obj.Source else []

    def onDelete(self, vobj, subelements):
        for each in self.claimChildren():
            each.Visibility = True
        return True
