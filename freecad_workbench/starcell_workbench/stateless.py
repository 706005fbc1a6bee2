"""What every proxy of ours is: without state of its own. All state is in properties, so there is nothing to save."""


class Stateless:
    # FreeCAD 0.20 calls the first pair, newer versions the second.

    def __getstate__(self):
        return None

    def __setstate__(self, state):
        return None

    dumps = __getstate__
    loads = __setstate__
