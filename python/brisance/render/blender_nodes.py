"""Shader graphs in Blender, written as expressions instead of wires."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray


def new_picture(name: str, texels: NDArray[np.floating[Any]]) -> Any:
    """A square picture of numbers in 0..1 (n, n, 4), which Blender takes as they are."""
    picture = bpy.data.images.new(name, texels.shape[1], texels.shape[0], alpha=True, is_data=True)
    picture.alpha_mode = "CHANNEL_PACKED"
    picture.pixels.foreach_set(np.ascontiguousarray(texels, dtype=np.float32).ravel())
    return picture


class Nodes:
    """Builds a node tree: every method adds nodes and gives back an output that others may take as input."""

    def __init__(self, owner: Any) -> None:
        """``owner`` is a material or a world; what it had is removed."""
        if hasattr(owner, "use_nodes") and owner.node_tree is None:
            owner.use_nodes = True
        self._tree = owner.node_tree
        self._tree.nodes.clear()
        self._output = "ShaderNodeOutputWorld" if owner.id_type == "WORLD" else "ShaderNodeOutputMaterial"

    def add(
        self, kind: str, *, output: int | str = 0, settings: dict[str, Any] | None = None, **inputs: Any
    ) -> Any:
        """A node of the given type, with its settings, and its inputs by name (spaces as underscores).

        An input is a number, a tuple, or another node's output.
        """
        node = self._tree.nodes.new(kind)
        for key, value in (settings or {}).items():
            setattr(node, key, value)
        for name, value in inputs.items():
            self._connect(_socket(node, name), value)
        return node.outputs[output] if node.outputs else node

    def maths(self, operation: str, *values: Any) -> Any:
        """Arithmetic on numbers: the operation is one of Blender's, such as MULTIPLY or POWER."""
        node = self._tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, value in zip(node.inputs, values, strict=False):
            self._connect(socket, value)
        return node.outputs[0]

    def mix(self, factor: Any, first: Any, second: Any) -> Any:
        """A blend of two colours, ``first`` at factor 0."""
        node = self._tree.nodes.new("ShaderNodeMix")
        node.data_type = "RGBA"
        for index, value in ((0, factor), (6, first), (7, second)):
            self._connect(node.inputs[index], value)
        return node.outputs[2]

    def ramp(self, value: Any, stops: list[tuple[float, tuple[float, float, float]]]) -> Any:
        """A colour looked up in a list of (place in 0..1, linear RGB)."""
        node = self._tree.nodes.new("ShaderNodeValToRGB")
        elements = node.color_ramp.elements
        while len(elements) < len(stops):
            elements.new(0.5)
        for element, (place, colour) in zip(elements, stops, strict=True):
            element.position, element.color = place, (*colour, 1.0)
        self._connect(node.inputs[0], value)
        return node.outputs[0]

    def picture(self, image: Any, place: Any, *, side: float, boxed: bool = False) -> Any:
        """The colour of a tiled picture ``side`` metres wide, flat on XY or, boxed, around a solid."""
        scaled = self.add(
            "ShaderNodeVectorMath", settings={"operation": "SCALE"}, Vector=place, Scale=1.0 / side
        )
        settings = {"image": image, "projection": "BOX" if boxed else "FLAT", "extension": "REPEAT"}
        return self.add("ShaderNodeTexImage", settings=settings, Vector=scaled)

    def turned(self, place: Any, angle: float) -> Any:
        """A place turned about Z by an angle [rad]."""
        return self.add("ShaderNodeMapping", Vector=place, Rotation=(0.0, 0.0, angle))

    def channels(self, colour: Any) -> Any:
        """Red, green and blue of a colour, as three numbers."""
        red = self.add("ShaderNodeSeparateColor", Color=colour)
        return red.node.outputs

    def bump(self, height: Any, *, depth: float) -> Any:
        """A normal bent by a height in 0..1 that stands for ``depth`` metres."""
        return self.add("ShaderNodeBump", Height=height, Distance=depth)

    def surface(self, shader: Any) -> None:
        """Make a shader what the material or the world shows."""
        self.add(self._output, Surface=shader)

    def _connect(self, socket: Any, value: Any) -> None:
        if hasattr(value, "links"):
            self._tree.links.new(value, socket)
        elif isinstance(value, tuple) and len(value) == 3 and socket.type == "RGBA":
            socket.default_value = (*value, 1.0)
        else:
            socket.default_value = value


def _socket(node: Any, name: str) -> Any:
    """An input by its identifier, in which a space may be written as an underscore."""
    sockets = {socket.identifier: socket for socket in node.inputs}
    return sockets[name] if name in sockets else sockets[name.replace("_", " ")]
