# SPDX-License-Identifier: MIT
"""A bar for progress=True: tqdm's where it is there."""


class _Bar:
    """Shows the share of a pass that is done."""

    def __init__(self, tqdm):
        self._bar = tqdm(total=100, unit="%", leave=False)

    def __call__(self, progress):
        self._bar.set_description(progress.stage)
        if progress.share is not None:
            self._bar.update(round(100 * progress.share) - self._bar.n)
        if progress.done:
            self._bar.close()


def callback_of(progress):
    """What to call for `progress`: None, True (a bar, where tqdm is there), or a callable."""
    if progress is not True:
        return None if progress is False else progress
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return _Bar(tqdm)
