<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="ru" sourcelanguage="en">
<context>
    <name>Subject</name>
    <message>
        <source>Please wait</source>
        <translation>Пожалуйста, подождите</translation>
    </message>
    <message>
        <source>Move to the grey sphere and rest there</source>
        <translation>Переместитесь к серому шару и остановитесь</translation>
    </message>
    <message>
        <source>Wait for the signal</source>
        <translation>Ждите сигнала</translation>
    </message>
    <message>
        <source>Move to the yellow sphere</source>
        <translation>Двигайтесь к жёлтому шару</translation>
    </message>
    <message>
        <source>Go</source>
        <translation>Вперёд</translation>
    </message>
    <message>
        <source>Well done</source>
        <translation>Отлично</translation>
    </message>
    <message>
        <source>Too fast</source>
        <translation>Слишком быстро</translation>
    </message>
    <message>
        <source>Not at the target in time</source>
        <translation>Цель не достигнута вовремя</translation>
    </message>
    <message>
        <source>Not at rest in time</source>
        <translation>Движение не остановлено вовремя</translation>
    </message>
    <message>
        <source>Not through every ball on the way</source>
        <translation>Пройдены не все шары на пути</translation>
    </message>
    <message>
        <source>Too early: wait for the signal</source>
        <translation>Слишком рано: ждите сигнала</translation>
    </message>
    <message>
        <source>No movement began</source>
        <translation>Движение не началось</translation>
    </message>
    <message>
        <source>This trial does not count</source>
        <translation>Эта попытка не считается</translation>
    </message>
    <message>
        <source>Rest a little</source>
        <translation>Немного отдохните</translation>
    </message>
    <message>
        <source>That was all: thank you</source>
        <translation>Это всё, спасибо</translation>
    </message>
</context>
</TS>
