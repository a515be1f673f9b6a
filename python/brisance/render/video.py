"""Pictures to an H.264 video that plays everywhere: 8 bits, 4:2:0, index first."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from av.container import OutputContainer
    from av.video.frame import VideoFrame

QUALITY = 17
"""Constant rate factor of the encoder: 0 loses nothing, 51 most; 17 is hard to tell from the pictures."""


class VideoWriter:
    """Encodes pictures as they come; use as a context manager. The file is complete when the block ends well.

    ``size`` is even in both directions; ``fps`` is pictures a second.
    """

    def __init__(self, path: Path, *, size: tuple[int, int], fps: int) -> None:
        import av

        self._container: OutputContainer = av.open(str(path), "w", options={"movflags": "+faststart"})
        self._stream = self._container.add_stream("libx264", rate=fps, options={"crf": str(QUALITY)})
        self._stream.width, self._stream.height = size
        self._stream.pix_fmt = "yuv420p"
        context = self._stream.codec_context
        context.time_base = Fraction(1, fps)
        context.colorspace = context.color_primaries = context.color_trc = _BT709
        context.color_range = _LIMITED_RANGE

    def __enter__(self) -> VideoWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                self._container.mux(self._stream.encode(None))
        finally:
            self._container.close()

    def add(self, picture: NDArray[np.uint8], *, times: int = 1) -> None:
        """Show a picture (height, width, 3), sRGB, for a number of video frames."""
        import av

        for _ in range(times):
            frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
            self._container.mux(self._stream.encode(_to_yuv(frame)))


_BT709 = 1
"""The code of Rec. 709 for matrix, primaries and transfer (ISO/IEC 23091-2)."""

_LIMITED_RANGE = 1
"""Luma from 16 to 235 ("MPEG" range)."""


def read_picture(path: Path) -> NDArray[np.uint8]:
    """A picture file as (height, width, 3), sRGB."""
    import av

    with av.open(str(path)) as container:
        return np.asarray(next(container.decode(video=0)).to_ndarray(format="rgb24"), dtype=np.uint8)


def _to_yuv(frame: VideoFrame) -> VideoFrame:
    return frame.reformat(format="yuv420p", dst_colorspace="ITU709", dst_color_range="MPEG")
