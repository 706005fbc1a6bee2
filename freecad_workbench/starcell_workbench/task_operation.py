"""The task panel of every operation: operands, precision, own parameters, and what was proved.

Apply computes and stays; OK computes and closes unless that failed; Cancel takes back what was not applied. An empty length
is an automatic one.
"""
import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from . import lengths, report, resources
from .commands import selected
from .panel_estimate import PanelEstimate
from .operation_feature import recompute
from .translation import translate


class OperationTask:
    def __init__(self, obj):
        self.obj = obj
        self.feature = obj.Proxy
        self.form = FreeCADGui.PySideUic.loadUi(resources.ui("operation"))
        self.form.setWindowTitle(obj.Label)
        self.form.setWindowIcon(QtGui.QIcon(resources.icon(self.feature.command)))
        self.form.addOperands.clicked.connect(self.add_operands)
        self.form.removeOperands.clicked.connect(self.remove_operands)
        self.form.apply.clicked.connect(self.apply)
        self.form.showPlaces.toggled.connect(self.show_places)
        # A dragged row is in place only after the drop.
        self.settle = QtCore.QTimer(self.form, singleShot=True, interval=0)
        self.settle.timeout.connect(self.show_roles)
        for changed in (self.form.operands.model().rowsInserted, self.form.operands.model().rowsRemoved, self.form.operands.model().rowsMoved):
            changed.connect(lambda *_: self.settle.start())
        self.form.operands.itemSelectionChanged.connect(self.select_in_view)
        self.fields = {"Error": self.form.error, "Contact": self.form.contact}
        self.fields.update((parameter.name, self._add_parameter(parameter)) for parameter in self.feature.parameters)
        self.read_object()
        self.estimate = PanelEstimate(self)
        obj.Document.openTransaction(translate("StarCell", "Edit {}").format(obj.Label))

    # What FreeCAD calls.

    def getStandardButtons(self):
        buttons = QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel
        return int(getattr(buttons, "value", buttons))  # Qt 6 has the number in .value

    def accept(self):
        return self.apply() and self._leave()  # False keeps the panel open

    def reject(self):
        return self._leave()

    def _leave(self):
        self.estimate.stop()
        self.settle.stop()
        self.obj.Document.abortTransaction()
        FreeCADGui.getDocument(self.obj.Document.Name).resetEdit()
        FreeCADGui.Control.closeDialog()
        return True

    # The work.

    def apply(self):
        """Writes the panel to the object and recomputes. Whether that went well."""
        document = self.obj.Document
        self.estimate.stop()  # the run wants the machine for itself
        try:
            self.write_object()
        except ValueError as problem:
            self.show_problem(str(problem))
            return False
        recompute(self.obj)
        self.show_result()
        if self.obj.isValid():
            document.commitTransaction()
            document.openTransaction(translate("StarCell", "Edit {}").format(self.obj.Label))
        return self.obj.isValid()

    def read_object(self):
        self.form.operands.clear()
        for each in self.feature.linked(self.obj):
            self._add_row(each)
        for name, field in self.fields.items():
            field.setText(_shown(getattr(self.obj, name)))
        self.show_result()

    def values(self):
        """{property: value} as the fields say. Raises ValueError."""
        return {name: self._names(name) if isinstance(getattr(self.obj, name), list) else self._number(name) for name in self.fields}

    def links(self):
        """{role: objects} as the list says."""
        rest = [self.obj.Document.getObject(row.data(QtCore.Qt.UserRole)) for row in self._rows()]
        return {role.name: rest if role.many else [rest.pop(0)] if rest else [] for role in self.feature.roles}

    def write_object(self):
        values, links = self.values(), self.links()
        for role in self.feature.roles:
            if self.feature.linked_by(self.obj, role) != links[role.name]:
                setattr(self.obj, role.name, links[role.name] if role.many else next(iter(links[role.name]), None))
        for name, value in values.items():
            now = getattr(self.obj, name)
            if (now if isinstance(now, list) else now.Value) != value:
                setattr(self.obj, name, value)

    def _number(self, name):
        text = self.fields[name].text().strip()
        if getattr(self.obj, name).Unit == FreeCAD.Units.Angle:
            return lengths.parse_angle(text, name)
        parse = lengths.parse_positive if name in ("Error", "Contact") else lengths.parse
        return parse(text, name) if text else 0.0

    def _names(self, name):
        return [each.strip() for each in self.fields[name].text().split(",") if each.strip()]

    def show_result(self):
        obj, form = self.obj, self.form
        problem = "" if obj.isValid() else obj.getStatusString()
        self.show_problem(problem)
        form.result.setTitle(translate("StarCell", "Last good result") if problem else translate("StarCell", "Result"))
        form.verdict.setText(obj.Verdict)
        form.bound.setText(lengths.show(obj.ErrorBound) if obj.Verdict else "")
        form.components.setText(str(obj.Components))
        form.genus.setText(report.genus(obj.Genus))
        form.triangles.setText(str(obj.Triangles))
        form.volume.setText("{:.6g} mm³".format(obj.Volume.Value))
        form.seconds.setText("{:.2f}".format(obj.Seconds))
        form.report.setText(obj.Report)
        self.show_highlighted()

    def show_highlighted(self):
        highlighted, box = self.feature.highlighted, self.form.showPlaces
        box.setVisible(bool(highlighted and getattr(self.obj, highlighted.places)))
        if highlighted:
            box.setText(translate("StarCell", highlighted.title))
            box.setToolTip(translate("App::Property", highlighted.help))
            box.setChecked(getattr(self.obj.ViewObject, highlighted.switch, False))

    def show_places(self, wanted):
        if self.feature.highlighted:
            setattr(self.obj.ViewObject, self.feature.highlighted.switch, wanted)

    def show_problem(self, text):
        self.form.problem.setText(text)
        self.form.problem.setVisible(bool(text))

    # The list of operands.

    def add_operands(self):
        present = {row.data(QtCore.Qt.UserRole) for row in self._rows()}
        for each in selected():
            if each.Name in present:
                continue
            if each.Document is not self.obj.Document or each is self.obj or self.obj in each.OutListRecursive:
                self.show_problem(translate("StarCell", "'{}' cannot be an operand: it depends on this result, or lives in "
                                                        "another document.").format(each.Label))
                continue
            self._add_row(each)

    def remove_operands(self):
        for row in self.form.operands.selectedItems():
            self.form.operands.takeItem(self.form.operands.row(row))

    def show_roles(self):
        """Says in each row what the operand is for, where an operation has more than one role."""
        roles = list(self.feature.roles)
        for row in self._rows():
            each = self.obj.Document.getObject(row.data(QtCore.Qt.UserRole))
            name = "" if len(self.feature.roles) == 1 or not roles else "   ({})".format(roles[0].name)
            row.setText(each.Label + name)
            if roles and not roles[0].many:
                roles.pop(0)

    def select_in_view(self):
        FreeCADGui.Selection.clearSelection()
        for row in self.form.operands.selectedItems():
            FreeCADGui.Selection.addSelection(self.obj.Document.Name, row.data(QtCore.Qt.UserRole))

    def _rows(self):
        return [self.form.operands.item(index) for index in range(self.form.operands.count())]

    def _add_row(self, each):
        row = QtGui.QListWidgetItem(each.ViewObject.Icon, each.Label, self.form.operands)
        row.setData(QtCore.Qt.UserRole, each.Name)

    def _add_parameter(self, parameter):
        field = QtGui.QLineEdit(self.form)
        field.setToolTip(translate("App::Property", parameter.help))
        self.form.precisionLayout.insertRow(0, parameter.name, field)
        return field


def _shown(value):
    if isinstance(value, list):
        return ", ".join(value)
    if value.Unit == FreeCAD.Units.Angle:
        return "{!r} deg".format(value.Value)
    return "{!r} mm".format(value.Value) if value.Value else ""
