"""The checks of distance and of wavelengths: the places of features and waves."""
