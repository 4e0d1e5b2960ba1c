from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pt._film import Film
from pt._scene_file import Display
from pt.view._frame import LAYERS, OF_SAMPLES, Frame, facts_of, name_of
from pt.view._rejected import rejected_samples


class Still:
    def __init__(self, film: Film, name: str, published: Callable[[Frame], None]) -> None:
        self._published = published
        self._values = tuple(film.readback(quantity) for quantity in list(LAYERS.values())[:OF_SAMPLES])
        info, stats = film.info, film.stats()
        self._spoilt = rejected_samples(film) > 0 if stats.rejected_samples else None
        self._state = {
            **facts_of(film.error_estimate()), "name": name, "samples": stats.mean_sample_count, "size": [info.columns, info.rows],
            "width": info.columns, "height": info.rows, "rejected": stats.rejected_samples,
            "spoilt": 0 if self._spoilt is None else int(self._spoilt.sum()), "device": info.device,
            "display": vars(Display()), "max_path_length": info.max_path_length,
            "sampler": name_of(info.sampler), "estimator": name_of(info.estimator), "history": [], "faults": []}
        self.frame = Frame(0, {}, None)
        self.change()

    def change(self, layer: str = "radiance", **_: Any) -> None:
        index = list(LAYERS).index(layer)
        if index < OF_SAMPLES:
            self.frame = Frame(self.frame.number + 1, {**self._state, "layer": layer}, self._values[index], self._values,
                               self._spoilt)
            self._published(self.frame)

    def watch(self, is_watched: bool) -> None:
        pass

    def close(self) -> None:
        pass

    def trace(self, x: int, y: int, sample: int) -> dict[str, Any]:
        raise ValueError("a film has no kernel")

    def saved(self) -> tuple[str, bytes] | None:
        return None
