"""Native formats in: recordings of other makers as `floatref.Recording`; profile files out.

Everything here is a plug-in of the entry-point group `floatref` and uses the public names of
`floatref` only, as an adapter of any vendor would.
"""
