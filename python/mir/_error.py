# SPDX-License-Identifier: MIT
"""The one exception type of the library."""


class Error(Exception):
    """What went wrong, why, and what to do.

    code: "invalid_argument", "invalid_input", "limit_exceeded", "unsupported", "no_device",
    "device", "out_of_memory", "io", "cancelled" or "internal".
    place: name of the argument or setting to blame, else the line of the library that noticed.
    """

    def __init__(self, message: str, code: str, place: str):
        super().__init__(message, code, place)
        self.code = code
        self.place = place

    def __str__(self) -> str:
        return self.args[0]
