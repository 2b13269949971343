"""The check of faults in a recording: their effect is local, or it is flagged."""
