"""A picture that is seen while it refines, in a page of the browser.

    from pt.view import View
    view = View("scene.json")   # or data of particles, or a film; in a notebook the last line of a cell shows it
    print(view.address)

The command is pt-view, which `pt view` runs.
"""

from pt.view._view import View

__all__ = ["View"]
