"""HDF5, NetCDF 4 and MATLAB 7.3."""
