"""The clocks of native streams, put onto the time base of the recording."""
