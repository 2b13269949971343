"""Sample data, drawn by the proving ground: what a new user tries the commands on."""
