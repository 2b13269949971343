"""A figure that a notebook shows as the last value of a cell, without pyplot and its state."""

from io import BytesIO

from matplotlib.figure import Figure


class ShownFigure(Figure):
    """A figure with a picture of itself in PNG."""

    def _repr_png_(self) -> bytes:
        picture = BytesIO()
        self.savefig(picture, format="png")
        return picture.getvalue()
