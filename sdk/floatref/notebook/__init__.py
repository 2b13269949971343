"""What a notebook or a script calls: a path processed, and values as tables of other libraries."""

from floatref.notebook.processing import process

__all__ = ["process"]
