"""Every operation of the workbench, in the order of menu and toolbar. A new one is its class, and its name here."""
from .boolean_feature import Cut, Intersection, Union
from .configuration_feature import ConfigurationSpace, FreePositions
from .minkowski_feature import MinkowskiSum
from .offset_feature import Closing, Erode, Offset, Opening, Shell
from .remesh_feature import Remesh
from .repair_feature import Repair
from .rescue_feature import Rescue
from .simplify_feature import Simplify

ALL = (Union, Cut, Intersection, Rescue, Offset, Shell, MinkowskiSum, Erode, Opening, Closing, Simplify, Remesh, Repair, ConfigurationSpace, FreePositions)
