"""Tab-separated text of profile viewers: a pair of columns for every channel."""
