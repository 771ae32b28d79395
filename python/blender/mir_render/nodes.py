# SPDX-License-Identifier: MIT
"""Reading node trees: which node feeds a socket, and which value; through node groups."""


class Input:
    """An input of a node, and the group nodes that lead to it, the outermost first."""

    def __init__(self, socket, groups: tuple):
        self._socket = socket
        self.groups = groups

    def __getattr__(self, name):
        return getattr(self._socket, name)


class Node:
    """A node, and the group nodes that lead to it, the outermost first."""

    def __init__(self, node, groups: tuple):
        self._node = node
        self._groups = groups

    def __getattr__(self, name):
        return getattr(self._node, name)

    @property
    def inputs(self) -> "Inputs":
        """Its inputs by name or number."""
        return Inputs(self._node.inputs, self._groups)


class Inputs:
    """The inputs of a node by name or number."""

    def __init__(self, sockets, groups: tuple):
        self._sockets = sockets
        self._groups = groups

    def __getitem__(self, key) -> Input:
        return Input(self._sockets[key], self._groups)

    def __contains__(self, name) -> bool:
        return name in self._sockets


def _same(sockets, socket):
    """The socket of a group's other side: names may repeat, identifiers do not."""
    return next((one for one in sockets if one.identifier == socket.identifier), None)


def _end_of(socket) -> Input:
    """The input where the way back from this one ends, past reroutes, into and out of groups."""
    groups = getattr(socket, "groups", ())
    while socket.is_linked:
        link = socket.links[0]
        node, back = link.from_node, None
        if node.type == "REROUTE":
            back = node.inputs[0]
        elif node.type == "GROUP" and node.node_tree is not None:
            output = active_output(node.node_tree, "GROUP_OUTPUT")
            back = output and _same(output.inputs, link.from_socket)
            groups = (*groups, node) if back else groups
        elif node.type == "GROUP_INPUT" and groups:
            back = _same(groups[-1].inputs, link.from_socket)
            groups = groups[:-1] if back else groups
        if not back:
            break
        socket = back
    return Input(socket, groups)


def source_of(socket):
    """The (node, socket) that feeds an input, past reroutes and groups; None where nothing does."""
    end = _end_of(socket)
    if not end.is_linked:
        return None
    link = end.links[0]
    return (Node(link.from_node, end.groups), link.from_socket)


def input_of(node, *names):
    """The first input of these names that the node has, or None: names change with versions."""
    return next((node.inputs[name] for name in names if name in node.inputs), None)


def active_output(tree, kind: str):
    """The output node of this kind that renders use, or None."""
    outputs = [node for node in tree.nodes if node.type == kind]
    return next((node for node in outputs if node.is_active_output), None)


def color_of(value) -> tuple:
    """Three floats of a colour or a number."""
    return tuple(value)[:3] if hasattr(value, "__len__") else (value,) * 3


def constant_of(socket):
    """The value of an input: of a node that holds one, else its own; and whether that is all."""
    end = _end_of(socket)
    if not end.is_linked:
        return end.default_value, True
    source = end.links[0].from_socket
    if source.node.type in {"RGB", "VALUE"}:
        return source.default_value, True
    return end.default_value, False
