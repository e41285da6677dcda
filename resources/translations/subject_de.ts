<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>Subject</name>
    <message>
        <source>Please wait</source>
        <translation>Bitte warten</translation>
    </message>
    <message>
        <source>Move to the grey sphere and rest there</source>
        <translation>Zur grauen Kugel gehen und dort ruhen</translation>
    </message>
    <message>
        <source>Wait for the signal</source>
        <translation>Auf das Zeichen warten</translation>
    </message>
    <message>
        <source>Move to the yellow sphere</source>
        <translation>Zur gelben Kugel bewegen</translation>
    </message>
    <message>
        <source>Go</source>
        <translation>Los</translation>
    </message>
    <message>
        <source>Well done</source>
        <translation>Gut gemacht</translation>
    </message>
    <message>
        <source>Too fast</source>
        <translation>Zu schnell</translation>
    </message>
    <message>
        <source>Not at the target in time</source>
        <translation>Nicht rechtzeitig am Ziel</translation>
    </message>
    <message>
        <source>Not at rest in time</source>
        <translation>Nicht rechtzeitig in Ruhe</translation>
    </message>
    <message>
        <source>Not through every ball on the way</source>
        <translation>Nicht durch jede Kugel auf dem Weg</translation>
    </message>
    <message>
        <source>Too early: wait for the signal</source>
        <translation>Zu früh: auf das Zeichen warten</translation>
    </message>
    <message>
        <source>No movement began</source>
        <translation>Keine Bewegung begonnen</translation>
    </message>
    <message>
        <source>This trial does not count</source>
        <translation>Dieser Versuch zählt nicht</translation>
    </message>
    <message>
        <source>Rest a little</source>
        <translation>Bitte etwas ausruhen</translation>
    </message>
    <message>
        <source>That was all: thank you</source>
        <translation>Das war alles: vielen Dank</translation>
    </message>
</context>
</TS>
