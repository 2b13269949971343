"""The checks of distance and of wavelengths: features and waves are where they are."""
