"""Recordings of native files, and of formats that hold recordings."""
