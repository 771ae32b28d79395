# SPDX-License-Identifier: MIT
"""What of a scene mir cannot show."""


class Losses:
    """Sentences, each once, in the order in which they were found."""

    def __init__(self):
        self._sentences = {}

    def add(self, place: str, what: str) -> None:
        """Notes that `what` of `place` is not in the picture as Cycles would show it."""
        self._sentences[f"{place}: {what}"] = None

    def __iter__(self):
        return iter(self._sentences)

    def __len__(self):
        return len(self._sentences)
