"""A picture that refines in a page of the browser.

    from pt.view import View

    view = View("scene.json")   # or data of particles, or a film
    print(view.address)
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pt.view._view import View

__all__ = ["View"]


def __getattr__(name: str) -> Any:
    """Imports View on first use, because it needs aiohttp, which --help does not."""
    if name != "View":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from pt.view._view import View
    return View
