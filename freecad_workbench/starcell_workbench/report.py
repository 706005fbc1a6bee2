"""What was proved, on the object: the certificate as properties, as JSON, and in words."""
import itertools
import json

import FreeCAD

from . import lengths, mesh_transfer
from .translation import translate


def publish(obj, result, asked, linked, seconds):
    """Fills the output properties of `obj`. The report view gets a message of contacts, a warning of what is unresolved."""
    certificate = result.certificate
    obj.Verdict = certificate.verdict
    obj.ErrorBound = certificate.error_bound
    obj.Components = certificate.components
    obj.Genus = list(certificate.genus)
    obj.Triangles = len(result.triangles)
    obj.Volume = mesh_transfer.volume(result.vertices, result.triangles)
    obj.Seconds = seconds
    obj.Certificate = to_json(certificate)
    obj.Report = in_words(obj, certificate, asked, linked)
    line = "{}: {}\n".format(obj.Label, summary(obj))
    console = FreeCAD.Console
    {"unresolved": console.PrintWarning, "contact": console.PrintMessage}.get(certificate.verdict, console.PrintLog)(line)


def to_json(certificate):
    """The certificate's fields as JSON text; lengths in mm, boxes as [lower, upper]."""
    fields = {name: getattr(certificate, name) for name in (
        "verdict", "error_bound", "requested_error", "contact_tolerance", "components", "genus", "euler_characteristic",
        "tessellated", "contacts", "unresolved", "statistics")}
    return json.dumps(fields, default=_plain)  # on one line: the property editor shows it


def summary(obj):
    """One line: verdict, bound, components, genus, triangles."""
    certificate = json.loads(obj.Certificate)
    text = translate("StarCell", "{}, within {}; components: {}; genus: {}; triangles: {}").format(
        obj.Verdict, lengths.show(obj.ErrorBound), obj.Components, genus(obj.Genus), obj.Triangles)
    if obj.Verdict == "unresolved":
        text += translate("StarCell", "; unresolved places: {}").format(len(certificate["unresolved"]))
    return text


def in_words(obj, certificate, asked, linked):
    """The certificate for the person at the screen, a sentence a line."""
    lines = [_VERDICTS[certificate.verdict]().format(lengths.show(certificate.error_bound), len(certificate.unresolved))]
    if obj.Error.Value:
        lines.append(translate("StarCell", "Error asked for: {}.").format(lengths.show(asked)))
    else:
        lines.append(translate("StarCell", "Error asked for: {} (automatic, longest side / {}).").format(lengths.show(asked), obj.ErrorDivisor))
    if certificate.components:
        lines.append(translate("StarCell", "Components: {}; genus: {}; triangles: {}; volume: {:.6g} mm³; {:.2f} s.").format(
            certificate.components, genus(certificate.genus), obj.Triangles, obj.Volume.Value, obj.Seconds))
    else:
        lines.append(translate("StarCell", "The result is empty."))
    for name, deflection in certificate.tessellated:
        lines.append(translate("StarCell", "Curved faces of {} were approximated; measured deviation {}, counted in the bound. The topology "
                                           "is that of the approximation.").format(name, lengths.show(deflection)))
    for each in linked:
        inner = each.getLinkedObject(True)
        if getattr(inner, "ErrorBound", None) is not None and inner.isDerivedFrom("Mesh::Feature"):
            lines.append(translate("StarCell", "'{}' is taken as its mesh, which is within {} of its own true surface ({}).").format(
                each.Label, lengths.show(inner.ErrorBound), inner.Verdict))
    lines += _places(translate("StarCell", "Contact"), certificate.contacts)
    lines += _places(translate("StarCell", "Unresolved"), certificate.unresolved)
    return "\n".join(lines)


_VERDICTS = {
    "exact": lambda: translate("StarCell", "Exact: the mesh has the topology of the true surface, and lies within {0} of it."),
    "contact": lambda: translate("StarCell", "Contact: parts touch. The mesh has the topology of the solids moved by at most the contact "
                                             "tolerance, and lies within {0} of the true surface."),
    "unresolved": lambda: translate("StarCell", "Unresolved: the mesh is closed and free of self-intersections, but in some places ({1}) nothing "
                                                "is proved of its topology; a budget ran out."),
}


def genus(handles):
    """Handles of each component, equal neighbours together: '3, 0 (12 times)'."""
    runs = [(value, len(list(run))) for value, run in itertools.groupby(handles)]
    return ", ".join(str(value) if count == 1 else translate("StarCell", "{} ({} times)").format(value, count) for value, count in runs) or "-"


def _places(name, boxes, shown=3):
    lines = []
    for lower, upper in boxes[:shown]:
        centre = [(a + b) / 2 for a, b in zip(lower, upper)]
        lines.append(translate("StarCell", "{} near ({:.6g}, {:.6g}, {:.6g}).").format(name, *centre))
    if len(boxes) > shown:
        lines.append(translate("StarCell", "… and {} more.").format(len(boxes) - shown))
    return lines


def _plain(value):
    """numpy's numbers and arrays for json."""
    return value.tolist()
