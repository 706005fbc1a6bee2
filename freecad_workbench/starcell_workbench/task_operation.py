"""The task panel of every operation: operands, precision, own parameters, and what was proved.

Apply computes and stays; OK computes and closes unless that failed; Cancel takes back what was not applied.
"""
import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from . import report, resources
from .commands import selected
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
        self.form.operands.model().rowsMoved.connect(self.show_roles)
        self.form.operands.itemSelectionChanged.connect(self.select_in_view)
        self.parameters = {parameter.name: self._add_parameter(parameter) for parameter in self.feature.parameters}
        self.read_object()
        obj.Document.openTransaction(translate("StarCell", "Edit {}").format(obj.Label))

    # What FreeCAD calls.

    def getStandardButtons(self):
        return int(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Apply | QtGui.QDialogButtonBox.Cancel)

    def clicked(self, button):
        if button == QtGui.QDialogButtonBox.Apply:
            self.apply()

    def accept(self):
        if self.apply():
            self._leave()
        return True

    def reject(self):
        self.obj.Document.abortTransaction()
        self._leave()
        return True

    def _leave(self):
        FreeCADGui.getDocument(self.obj.Document.Name).resetEdit()
        FreeCADGui.Control.closeDialog()

    # The work.

    def apply(self):
        """Writes the panel to the object and recomputes. Whether that went well."""
        document = self.obj.Document
        self.write_object()
        self.obj.touch()
        document.recompute()
        self.show_result()
        if self.obj.isValid():
            document.commitTransaction()
            document.openTransaction(translate("StarCell", "Edit {}").format(self.obj.Label))
        return self.obj.isValid()

    def read_object(self):
        self.form.operands.clear()
        for each in self.feature.linked(self.obj):
            self._add_row(each)
        self.show_roles()
        self.form.error.setProperty("rawValue", self.obj.Error.Value)
        self.form.contact.setProperty("rawValue", self.obj.Contact.Value)
        for name, field in self.parameters.items():
            field.setProperty("rawValue", getattr(self.obj, name).Value)
        self.show_result()

    def write_object(self):
        rest = [self.obj.Document.getObject(row.data(QtCore.Qt.UserRole)) for row in self._rows()]
        for role in self.feature.roles:
            value = rest if role.many else rest.pop(0) if rest else None
            if self.feature.linked_by(self.obj, role) != (value if role.many else [value]):
                setattr(self.obj, role.name, value)
        for name, field in dict(self.parameters, Error=self.form.error, Contact=self.form.contact).items():
            if getattr(self.obj, name).Value != field.property("rawValue"):
                setattr(self.obj, name, field.property("rawValue"))

    def show_result(self):
        obj, form = self.obj, self.form
        problem = "" if obj.isValid() else obj.getStatusString()
        form.problem.setText(problem)
        form.problem.setVisible(bool(problem))
        form.result.setTitle(translate("StarCell", "Result of the last successful run") if problem else translate("StarCell", "Result"))
        form.verdict.setText(obj.Verdict)
        form.bound.setText(report.length(obj.ErrorBound) if obj.Verdict else "")
        form.components.setText(str(obj.Components))
        form.genus.setText(", ".join(map(str, obj.Genus)))
        form.triangles.setText(str(obj.Triangles))
        form.volume.setText(obj.Volume.UserString)
        form.seconds.setText("{:.2f}".format(obj.Seconds))
        form.report.setText(obj.Report)

    # The list of operands.

    def add_operands(self):
        present = {row.data(QtCore.Qt.UserRole) for row in self._rows()}
        for each in selected():
            if each.Name in present:
                continue
            if each.Document is not self.obj.Document or each is self.obj or self.obj in each.OutListRecursive:
                self.form.problem.setText(translate("StarCell", "'{}' cannot be an operand: it depends on this result, or lives in "
                                                                "another document.").format(each.Label))
                self.form.problem.show()
                continue
            self._add_row(each)
        self.show_roles()

    def remove_operands(self):
        for row in self.form.operands.selectedItems():
            self.form.operands.takeItem(self.form.operands.row(row))
        self.show_roles()

    def show_roles(self, *moved):
        """Says in each row what the operand is for, where an operation has more than one role."""
        roles = list(self.feature.roles)
        for row in self._rows():
            each = self.obj.Document.getObject(row.data(QtCore.Qt.UserRole))
            name = "" if len(self.feature.roles) == 1 else "   ({})".format(roles[0].name)
            row.setText(each.Label + name)
            if not roles[0].many:
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
        field = FreeCADGui.UiLoader().createWidget("Gui::QuantitySpinBox")
        field.setProperty("unit", getattr(self.obj, parameter.name).getUserPreferred()[2])
        field.setToolTip(translate("App::Property", parameter.help))
        self.form.precisionLayout.insertRow(0, parameter.name, field)
        return field
