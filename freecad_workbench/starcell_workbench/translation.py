"""Translating texts: `translate(context, text)` at run time, `QT_TRANSLATE_NOOP` to mark a text for later."""
import FreeCAD

translate = FreeCAD.Qt.translate


def QT_TRANSLATE_NOOP(context, text):
    """The text itself; only marks it for the translation tools."""
    return text
