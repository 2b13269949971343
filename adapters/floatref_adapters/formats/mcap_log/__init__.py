"""MCAP files of recordings, for PlotJuggler and Foxglove, out and in."""
