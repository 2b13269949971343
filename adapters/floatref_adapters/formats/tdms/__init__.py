"""NI TDMS."""
