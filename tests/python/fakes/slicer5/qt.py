"""As much of Slicer's module qt as Ream uses: widgets have the properties and signals that Qt's have, and no others."""

from collections.abc import Callable
from typing import Any


class QObject:
    """Emits the signals of `signals`; takes no attribute that is no property of its kind."""

    signals: tuple[str, ...] = ()
    properties: dict[str, Any] = {}

    def __init__(self) -> None:
        object.__setattr__(self, "_values", {})
        object.__setattr__(self, "_slots", {})
        for kind in reversed(type(self).__mro__):
            self._values.update(vars(kind).get("properties", {}))

    def __getattr__(self, name: str) -> Any:
        try:
            return object.__getattribute__(self, "_values")[name]
        except KeyError:
            raise AttributeError(f"{type(self).__name__} has no {name}") from None

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in self._values:
            raise AttributeError(f"{type(self).__name__} has no property {name}")
        if type(value) is not type(self._values[name]):
            raise TypeError(f"{name} of {type(self).__name__} is {type(self._values[name]).__name__}, not {value!r}")
        changed = self._values[name] != value
        self._values[name] = value
        if changed:
            self.changed(name, value)

    def changed(self, name: str, value: Any) -> None:
        pass

    def connect(self, signal: str, slot: Callable) -> None:
        if signal not in self.signals:
            raise ValueError(f"{type(self).__name__} has no signal {signal}")
        self._slots.setdefault(signal, []).append(slot)

    def emit(self, signal: str, *values: Any) -> None:
        for slot in self._slots.get(signal, []):
            slot(*values)


class QWidget(QObject):
    properties = {"enabled": True, "toolTip": ""}


class QLabel(QWidget):
    properties = {"text": "", "wordWrap": False}


class QLineEdit(QWidget):
    properties = {"text": "", "echoMode": "QLineEdit::Normal"}


class QPushButton(QWidget):
    signals = ("clicked(bool)", "toggled(bool)")
    properties = {"text": "", "checkable": False, "checked": False}

    def changed(self, name: str, value: Any) -> None:
        if name == "checked":
            self.emit("toggled(bool)", value)

    def click(self) -> None:
        if not self.enabled:
            return
        if self.checkable:
            self.checked = not self.checked
        self.emit("clicked(bool)", self.checked)


class QSpinBox(QWidget):
    properties = {"value": 0, "minimum": 0, "maximum": 99}


class QDoubleSpinBox(QWidget):
    properties = {"value": 0.0, "minimum": 0.0, "maximum": 99.99, "singleStep": 1.0}


class QComboBox(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self._values["_items"] = []
        self._values["_chosen"] = -1

    def clear(self) -> None:
        self._values["_items"] = []
        self._values["_chosen"] = -1

    def addItem(self, text: str, data: Any = None) -> None:
        if not isinstance(text, str):
            raise TypeError("an item's text is str")
        self._items.append((text, data))
        self._values["_chosen"] = max(self._chosen, 0)

    @property
    def count(self) -> int:
        return len(self._items)

    @property
    def currentData(self) -> Any:
        return self._items[self._chosen][1] if self._items else None

    def choose(self, data: Any) -> None:
        """What a person does."""
        self._values["_chosen"] = [item[1] for item in self._items].index(data)


class QTimer(QObject):
    signals = ("timeout()",)

    def __init__(self) -> None:
        super().__init__()
        self._values["active"] = False

    def setInterval(self, ms: int) -> None:
        if not isinstance(ms, int):
            raise TypeError("setInterval(int)")

    def start(self) -> None:
        self._values["active"] = True

    def stop(self) -> None:
        self._values["active"] = False


class QVBoxLayout(QObject):
    def addWidget(self, widget: QWidget) -> None:
        if not isinstance(widget, QWidget):
            raise TypeError("addWidget(QWidget)")


class QSettings:
    """Those of the application: one for all."""

    _kept: dict[str, Any] = {}

    def value(self, key: str, default: Any = None) -> Any:
        return self._kept.get(key, default)

    def setValue(self, key: str, value: Any) -> None:
        self._kept[key] = value
