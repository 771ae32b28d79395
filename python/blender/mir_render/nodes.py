# SPDX-License-Identifier: MIT
"""Reading node trees: which node feeds a socket, and which value."""


def source_of(socket):
    """The (node, socket) that feeds an input, past reroutes; None where nothing does."""
    while socket.is_linked:
        link = socket.links[0]
        if link.from_node.type != "REROUTE":
            return (link.from_node, link.from_socket)
        socket = link.from_node.inputs[0]
    return None


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
    source = source_of(socket)
    if source is None:
        return socket.default_value, True
    if source[0].type in {"RGB", "VALUE"}:
        return source[1].default_value, True
    return socket.default_value, False
