from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from pt._display import encode_png, to_pixels
from pt._enums import Estimator, Sampler
from pt._files import Path, format_of, write_atomically
from pt._stats import ErrorEstimate, Stats


class Image:
    """A finished image of shape (height, width, 3). np.asarray(image) is the radiance.

    radiance         mean of the samples, linear RGB, float32, unclamped, >= 0
    standard_error   a rough hint for a single pixel, infinite with up to 8 samples
    sample_count     shape (height, width), uint32
    error_estimate   for the whole image
    exposure         stops; None: automatic
    coverage         alpha, shape (height, width), float32: the fraction of samples that hit a surface; None without
                     RenderSettings.coverage
    raw              mean of a denoised image's samples, to which standard_error belongs; else None
    sampler, estimator   BEST if unknown
    """

    def __init__(self, radiance: npt.NDArray[np.float32], standard_error: npt.NDArray[np.float32],
                 sample_count: npt.NDArray[Any], error_estimate: ErrorEstimate, stats: Stats,
                 exposure: float | None = None, raw: npt.NDArray[np.float32] | None = None,
                 sampler: Sampler = Sampler.BEST, estimator: Estimator = Estimator.BEST,
                 coverage: npt.NDArray[np.float32] | None = None) -> None:
        self.radiance = radiance
        self.raw = raw
        self.standard_error = standard_error
        self.sample_count: npt.NDArray[np.uint32] = sample_count[:, :, 0].astype(np.uint32)
        self.error_estimate = error_estimate
        self.stats = stats
        self.exposure = exposure
        self.sampler = sampler
        self.estimator = estimator
        self.coverage = None if coverage is None else coverage[:, :, 0]

    @property
    def shape(self) -> tuple[int, ...]:
        return self.radiance.shape

    @property
    def error(self) -> float:
        """Relative root mean square error; 0.01 is 1%; infinite below 16 samples."""
        return self.error_estimate.relative_rmse

    @property
    def error_bounds(self) -> tuple[float, float]:
        """With 95% confidence."""
        return self.error_estimate.relative_rmse_low, self.error_estimate.relative_rmse_high

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        array = self.radiance if dtype is None else self.radiance.astype(dtype, copy=False)
        return array.copy() if copy and array is self.radiance else array

    def __getitem__(self, index: Any) -> Any:
        return self.radiance[index]

    def __len__(self) -> int:
        return len(self.radiance)

    @property
    def picture_size(self) -> tuple[int, int]:
        return self.shape[1], self.shape[0]

    def __repr__(self) -> str:
        width, height = self.picture_size
        low, high = self.error_bounds
        return (f"<pt.Image {width}x{height}, {self.stats.mean_sample_count:.4g} samples a pixel, "
                f"error {self.error:.3g} ({low:.3g} to {high:.3g})>")

    def to_srgb8(self, exposure: float | None = None, **display: Any) -> npt.NDArray[np.uint8]:
        """Returns the sRGB picture, shape (height, width, 3).

        exposure   stops; by default the image's exposure, else the one that brings the average to middle grey, 0.18
        display    curve (a Curve), gamma (instead of sRGB's curve) and white (R, G, B of light that is shown as grey)
        """
        return to_pixels(self.radiance, self.exposure if exposure is None else exposure, **display)

    def save(self, path: Path, *, exposure: float | None = None) -> None:
        """Writes the picture (.png) or the radiance (.npy) atomically. Raises ValueError for another ending."""
        if format_of(path, ("png", "npy")) == "npy":
            write_atomically(path, lambda file: np.save(file, self.radiance, allow_pickle=False))
        else:
            data = encode_png(self.to_srgb8(exposure))
            write_atomically(path, lambda file: file.write(data))

    def _repr_png_(self) -> bytes:
        return encode_png(self.to_srgb8())
