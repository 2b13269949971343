"""What an operator sees of a live run: one model, a view in the terminal, and a page."""
