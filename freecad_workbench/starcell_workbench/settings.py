"""The user's preferences (Edit > Preferences > StarCell)."""
import FreeCAD

DEFAULT_DIVISOR = 128


def _group():
    return FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/StarCell")


def threads():
    """Threads the engine may use; 0: all. Results do not depend on it."""
    return max(0, _group().GetInt("Threads", 0))


def automatic_error_divisor():
    """New objects get an automatic error of their longest side divided by this."""
    return max(1, _group().GetInt("AutomaticErrorDivisor", DEFAULT_DIVISOR))
